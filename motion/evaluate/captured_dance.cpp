#include "motion/evaluate/captured_dance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "base/file.hpp"
#include "motion/figures/label_tables.hpp"
#include "motion/skeleton/formats/motion_format.hpp"

namespace raks::motion {
namespace {

constexpr std::string_view kIdle = "idle";    // a figure's name: not danced
constexpr std::string_view kOther = "other";  // danced, but no figure that repeats
constexpr double kLongFault = 0.5;   // seconds; longer faults of head or hands alone are not masked
constexpr double kCountSlack = 2.0;  // frames; labels are whole frames, counts fractional

// The tables of a plan, with the role's labels only.
struct Tables {
    std::map<std::string, std::vector<FigureLabel>> labels;  // by take
    std::vector<CountTime> counts;
    std::vector<CaptureFault> faults;
};

Expected<Tables> load_tables(const CapturedDancePlan& plan) {
    Tables tables;
    auto labels = load_labels(plan.labels);
    if (!labels) {
        return fail(labels.error());
    }
    for (FigureLabel& label : *labels) {
        if (label.role == plan.role) {
            tables.labels[label.take].push_back(std::move(label));
        }
    }
    if (tables.labels.empty()) {
        return fail(plan.labels.string() + ": has no labels of the " +
                    std::string(kRoleNames[static_cast<std::size_t>(plan.role)]));
    }
    if (plan.counts) {
        auto counts = load_counts(*plan.counts);
        if (!counts) {
            return fail(counts.error());
        }
        tables.counts = std::move(*counts);
    }
    if (plan.faults) {
        auto faults = load_faults(*plan.faults);
        if (!faults) {
            return fail(faults.error());
        }
        tables.faults = std::move(*faults);
    }
    return tables;
}

/// Whether a name in the count table means this take: "60_03" is take "60_03", or half of the pair
/// "03".
bool is_of_take(const std::string& name, const std::string& take) {
    return name == take || name == take.substr(take.find('_') + 1);
}

// Whether a fault concerns head or hands alone; `joints` as the table names them.
bool is_head_or_hands_alone(std::string_view joints) {
    while (!joints.empty()) {
        const std::size_t end = std::min(joints.find(','), joints.size());
        const std::string_view joint = joints.substr(0, end);
        if (joint != "head" && joint != "lHand" && joint != "rHand") {
            return false;
        }
        joints.remove_prefix(std::min(end + 1, joints.size()));
    }
    return true;
}

// Sets frames [from, to), as far as there are such.
void mark(std::vector<bool>& counted, std::size_t from, std::size_t to, bool value) {
    for (std::size_t f = from; f < std::min(to, counted.size()); ++f) {
        counted[f] = value;
    }
}

/// By frame whether it counts: between the first and the last figure, without idle stretches and
/// faults.
std::vector<bool> danced_frames(const BodyTrack& track,
                                const std::string& take,
                                const std::vector<FigureLabel>& labels,
                                const std::vector<CaptureFault>& faults) {
    std::vector<bool> counted(track.frames(), false);
    std::size_t first = track.frames();
    std::size_t last = 0;
    for (const FigureLabel& label : labels) {
        if (label.figure != kIdle) {
            first = std::min(first, label.start);
            last = std::max(last, label.end);
        }
    }
    // The order matters: idle stretches and faults are taken out of what is danced.
    mark(counted, first, last, true);
    for (const FigureLabel& label : labels) {
        if (label.figure == kIdle) {
            mark(counted, label.start, label.end, false);
        }
    }
    // The fault's last frame is included, hence + 1.
    for (const CaptureFault& fault : faults) {
        const double seconds = static_cast<double>(fault.to - fault.from) / track.frames_per_second;
        if (fault.take == take && !(seconds > kLongFault && is_head_or_hands_alone(fault.joints))) {
            mark(counted, fault.from, fault.to + 1, false);
        }
    }
    return counted;
}

/// Times in seconds of the label's counts and of the next figure's count 1: from the table where it
/// has all of them, otherwise evenly spaced.
std::vector<double> count_times(const FigureLabel& label,
                                const std::vector<CountTime>& counts,
                                double frames_per_second) {
    std::vector<double> times;
    const auto start = static_cast<double>(label.start);
    const auto end = static_cast<double>(label.end);
    for (const CountTime& count : counts) {
        if (is_of_take(count.take, label.take) && count.frame >= start - kCountSlack &&
            count.frame <= end + kCountSlack) {
            times.push_back(count.frame / frames_per_second);
        }
    }
    // Its counts, and the next figure's count 1.
    const auto wanted = static_cast<std::size_t>(label.beats) + 1;
    // A count missing or doubled would shift all later ones.
    if (times.size() != wanted) {
        times.clear();
        for (std::size_t k = 0; k < wanted; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(label.beats);
            times.push_back((start + share * (end - start)) / frames_per_second);
        }
    }
    return times;
}

// Adds the counts of a label for which there is a model of the same length; labels that start in
// the middle of a figure are left out.
void add_counts(const FigureLabel& label,
                const std::vector<double>& times,
                std::span<const FigureModel> models,
                std::vector<AudibleCount>& counts) {
    for (const FigureModel& model : models) {
        if (model.name == label.figure && model.beats == label.beats && label.start_count == 1) {
            for (std::size_t k = 0; k + 1 < times.size(); ++k) {
                counts.push_back({&model, k, times[k], times[k + 1] - times[k]});
            }
            return;
        }
    }
}

// The clip of a take: its BVH, or where there is none the first file of another format.
std::filesystem::path file_of(const std::string& take, const std::filesystem::path& folder) {
    const std::filesystem::path usual = folder / (take + ".bvh");
    if (is_there(usual)) {
        return usual;
    }
    // A folder that cannot be listed is reported by the reader of the file.
    const auto listed = list_folder(folder);
    for (const std::filesystem::path& path :
         listed ? *listed : std::vector<std::filesystem::path>()) {
        if (path.stem() == take && is_clip_name(path)) {
            return path;
        }
    }
    return usual;
}

// Measures one take.
CapturedDance measured(const BodyTrack& track,
                       const std::string& take,
                       const Tables& tables,
                       const CapturedDancePlan& plan,
                       std::span<const FigureModel> models) {
    const std::vector<FigureLabel>& labels = tables.labels.at(take);
    DanceSubject subject;
    subject.frames.counted = danced_frames(track, take, labels, tables.faults);
    // All counts of the take, also those outside its figures: the metrics cut them to the track.
    for (const CountTime& count : tables.counts) {
        if (is_of_take(count.take, take)) {
            subject.beat_times.push_back(count.frame / track.frames_per_second);
        }
    }
    std::vector<AudibleCount> counts;
    for (const FigureLabel& label : labels) {
        // Only sure labels of figures are repeats.
        if (label.figure != kIdle && label.figure != kOther &&
            label.confidence >= plan.min_confidence) {
            auto times = count_times(label, tables.counts, track.frames_per_second);
            add_counts(label, times, models, counts);
            subject.repeats.push_back({label.figure, std::move(times)});
        }
    }
    return {take,
            measure_dance(track, subject),
            landing_errors(track, counts),
            jerk_by_pace(track, subject.frames)};
}

}  // namespace

Expected<std::vector<CapturedDance>> measure_captured(const CapturedDancePlan& plan,
                                                      std::span<const FigureModel> models) {
    const auto tables = load_tables(plan);
    if (!tables) {
        return fail(tables.error());
    }
    std::vector<CapturedDance> dances;
    for (const auto& [take, labels] : tables->labels) {
        const std::filesystem::path file = file_of(take, plan.folder);
        auto clip = read_skeleton_motion(file, plan.reading);
        if (!clip) {
            return fail(clip.error());
        }
        clip->labels = plan.joints;
        const auto track = body_track(*clip, plan.metres_per_unit);
        if (!track) {
            return fail(file.string() + ": " + track.error().message);
        }
        // A take without a single frame that counts has no measures.
        const std::vector<bool> danced = danced_frames(*track, take, labels, tables->faults);
        if (std::find(danced.begin(), danced.end(), true) != danced.end()) {
            dances.push_back(measured(*track, take, *tables, plan, models));
        }
    }
    if (dances.empty()) {
        return fail(plan.labels.string() + ": no take is danced and without fault");
    }
    return dances;
}

}  // namespace raks::motion
