#include "training/figures/training_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/file.hpp"
#include "motion/skeleton/formats/motion_format.hpp"
#include "training/figures/label_counts.hpp"
#include "training/figures/repeat_features.hpp"
#include "training/figures/training_clip.hpp"

namespace raks::motion {

namespace fs = std::filesystem;

ClipUnits units_of(const FigureTrainingPlan& plan) {
    return {.reading = plan.reading,
            .metres_per_unit = plan.metres_per_unit,
            .height = plan.height,
            .up = plan.up,
            .joints = plan.joints,
            .travel = plan.travel};
}

Expected<std::map<std::string, fs::path>> clips_by_take(const FigureTrainingPlan& plan) {
    std::vector<fs::path> paths = plan.clips;
    std::error_code error;
    if (paths.size() == 1 && fs::is_directory(paths[0], error)) {
        const fs::path folder = paths[0];
        auto listed = list_folder(folder);
        if (!listed) {
            return fail(std::move(listed.error()));
        }
        paths = std::move(*listed);
        std::erase_if(paths, [](const fs::path& path) { return !is_clip_name(path); });
        if (paths.empty()) {
            return fail(folder.string() + ": holds no clip (.bvh, .amc, .glb, ...)");
        }
    }
    if (paths.empty()) {
        return fail("no clips given; name motion files or their folder");
    }
    std::map<std::string, fs::path> files;
    for (const fs::path& path : paths) {
        files[take_name(path)] = path;
    }
    return files;
}

namespace {

constexpr double kLongestBridge = 0.5;   ///< seconds of fault that may be bridged
constexpr double kFastestDance = 260.0;  ///< BPM; above it the frame rate is likely wrong

/// What errors call the labels.
std::string labels_name(const FigureTrainingPlan& plan) {
    return plan.labels.empty() ? "the repeats found" : plan.labels.filename().string();
}

/// False for faults of head and hands alone, because figures of captured motion do not learn them.
bool matters(const CaptureFault& fault) {
    std::string_view rest = fault.joints;
    // Walks the comma-separated list of joint names.
    while (!rest.empty()) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        const std::string_view joint = rest.substr(0, comma);
        if (joint != "head" && joint != "lHand" && joint != "rHand") {
            return true;
        }
        rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    return false;
}

// `end` of a label is exclusive, `to` of a fault inclusive.
bool overlaps(const CaptureFault& fault, const FigureLabel& label) {
    return fault.take == label.take && fault.from < label.end && fault.to >= label.start;
}

/// The tables that the plan names; counts and faults are empty where none is named.
struct Tables {
    std::vector<FigureLabel> labels;
    std::vector<CountTime> counts;
    std::vector<CaptureFault> faults;
};

// With music, the beats say how long a label is, so its column of beats may be missing.
Expected<Tables> load_tables(const FigureTrainingPlan& plan) {
    Tables tables;
    tables.labels = plan.found;
    if (!plan.labels.empty()) {
        Expected<std::vector<FigureLabel>> labels =
            load_labels(plan.labels, plan.music ? BeatsColumn::optional : BeatsColumn::required);
        if (!labels) {
            return fail(std::move(labels.error()));
        }
        tables.labels = std::move(*labels);
    }
    if (plan.counts) {
        Expected<std::vector<CountTime>> counts = load_counts(*plan.counts);
        if (!counts) {
            return fail(std::move(counts.error()));
        }
        tables.counts = std::move(*counts);
    }
    if (plan.faults) {
        Expected<std::vector<CaptureFault>> faults = load_faults(*plan.faults);
        if (!faults) {
            return fail(std::move(faults.error()));
        }
        tables.faults = std::move(*faults);
    }
    return tables;
}

/// Why a label is left out of training; empty when it is used.
std::string reason_to_leave_out(const FigureLabel& label,
                                const Tables& tables,
                                const FigureTrainingPlan& plan,
                                double frames_per_second) {
    if (label.confidence < plan.min_confidence) {
        return fmt::format("confidence {} is under {}", label.confidence, plan.min_confidence);
    }
    for (const CaptureFault& fault : tables.faults) {
        // A fault includes its last frame.
        const double seconds = static_cast<double>(fault.to - fault.from + 1) / frames_per_second;
        if (overlaps(fault, label) && matters(fault) && seconds > kLongestBridge) {
            return fmt::format("{} bad from frame {} to {}", fault.joints, fault.from, fault.to);
        }
    }
    return {};
}

// Faults that are short enough to be interpolated over. The longer ones exclude their labels.
void add_short_faults(const Tables& tables, TrainingClip& clip) {
    for (const CaptureFault& fault : tables.faults) {
        const double seconds =
            static_cast<double>(fault.to - fault.from + 1) / clip.frames_per_second;
        if (fault.take == clip.name && matters(fault) && seconds <= kLongestBridge) {
            clip.faults.push_back({fault.from, fault.to});
        }
    }
}

// Labels of other figures, roles or splits are not even reported.
bool is_wanted(const FigureLabel& label, const FigureTrainingPlan& plan) {
    return label.figure == plan.figure && label.role == plan.role &&
           (plan.split.empty() || label.split == plan.split);
}

// The label ends within its clip, whose length is known only after it is read.
Expected<void> check_range(const FigureLabel& label,
                           const TrainingClip& clip,
                           const FigureTrainingPlan& plan) {
    if (label.end > clip.poses.size()) {
        return fail(fmt::format("{}: line {}: end is {}, {} has {} frames",
                                labels_name(plan),
                                label.line,
                                label.end,
                                clip.name,
                                clip.poses.size()));
    }
    return {};
}

/// Collects clips and repeats label by label; reads each clip once, when a label needs it.
class Collector {
 public:
    Collector(const FigureTrainingPlan& plan,
              const Tables& tables,
              const std::map<std::string, fs::path>& files)
        : plan_(plan), tables_(tables), files_(files) {}

    Expected<void> add(const FigureLabel& label) {
        if (label.confidence < plan_.min_confidence) {  // before its clip is read, which is slow
            material_.uses.push_back({label, reason_to_leave_out(label, tables_, plan_, 1.0)});
            return {};
        }
        Expected<std::size_t> index = clip_of(label);
        if (!index) {
            return fail(std::move(index.error()));
        }
        const TrainingClip& clip = material_.clips[*index];
        if (auto ok = check_range(label, clip, plan_); !ok) {
            return ok;
        }
        std::string reason = reason_to_leave_out(label, tables_, plan_, clip.frames_per_second);
        if (reason.empty()) {
            Expected<LabelCounts> counts = counts_in(label, clip);
            if (!counts) {
                return fail(std::move(counts.error()));
            }
            reason = std::move(counts->left_out);
            if (reason.empty()) {
                add_repeat(*index, std::move(counts->frames), label.confidence);
            }
        }
        material_.uses.push_back({label, std::move(reason)});
        return {};
    }

    [[nodiscard]] TrainingMaterial& material() noexcept { return material_; }

 private:
    // Frames of the label's beats, from the table or from the music.
    Expected<LabelCounts> counts_in(const FigureLabel& label, const TrainingClip& clip) const {
        if (!plan_.music) {
            return LabelCounts{beat_frames_of(label, tables_.counts), {}};
        }
        Expected<LabelCounts> counts = counts_of(label, *plan_.music, clip.frames_per_second);
        if (!counts) {
            // The error names the table's line: the music alone does not tell which label is wrong.
            return fail(fmt::format(
                "{}: line {}: {}", labels_name(plan_), label.line, counts.error().message));
        }
        return counts;
    }

    void add_repeat(std::size_t clip, std::vector<double> frames, double weight) {
        // Half a frame of rounding may put the first and last count outside a whole clip.
        const auto last = static_cast<double>(material_.clips[clip].poses.size() - 1);
        frames.front() = std::max(frames.front(), 0.0);
        frames.back() = std::min(frames.back(), last);
        material_.repeats.push_back({clip, std::move(frames), weight});
    }

    // Index of the label's clip in the material, loaded on first use.
    Expected<std::size_t> clip_of(const FigureLabel& label) {
        if (const auto known = index_.find(label.take); known != index_.end()) {
            return known->second;
        }
        const auto file = files_.find(label.take);
        if (file == files_.end()) {
            return fail(fmt::format("{}: line {}: no clip named {} was given",
                                    labels_name(plan_),
                                    label.line,
                                    label.take));
        }
        Expected<TrainingClip> clip = load_clip(file->second, units_of(plan_), material_.warnings);
        if (!clip) {
            return fail(std::move(clip.error()));
        }
        add_short_faults(tables_, *clip);
        material_.clips.push_back(std::move(*clip));
        return index_[label.take] = material_.clips.size() - 1;
    }

    const FigureTrainingPlan& plan_;
    const Tables& tables_;
    const std::map<std::string, fs::path>& files_;
    std::map<std::string, std::size_t> index_;  // take -> index in material_.clips
    TrainingMaterial material_;
};

// The first repeat's number of beats; check_training refuses repeats of another length.
int beats_of(const TrainingMaterial& material) {
    return static_cast<int>(material.repeats[0].beat_frames.size()) - 1;
}

/// Drops the repeats whose flag in `kept` is false and notes the reason in their uses.
/// material.repeats are the uses that are not left out, in the same order.
void keep_repeats(const std::vector<bool>& kept, const char* reason, TrainingMaterial& material) {
    std::vector<FigureRepeat> repeats;
    std::size_t at = 0;
    for (RepeatUse& use : material.uses) {
        if (!use.left_out.empty()) {
            continue;
        }
        if (kept[at]) {
            repeats.push_back(material.repeats[at]);
        } else {
            use.left_out = reason;
        }
        ++at;
    }
    material.repeats = std::move(repeats);
}

/// Keeps the repeats with the commonest number of beats, of ties the smaller one: a figure has one
/// length, and labels without a column of beats take theirs from the tracked beats.
void keep_common_length(TrainingMaterial& material) {
    std::map<std::size_t, std::size_t> repeats_of;  // length -> how many
    for (const FigureRepeat& repeat : material.repeats) {
        ++repeats_of[repeat.beat_frames.size()];
    }
    // max_element returns the first of equals, and the map is sorted by length.
    const auto most =
        std::max_element(repeats_of.begin(), repeats_of.end(), [](const auto& a, const auto& b) {
            return a.second < b.second;
        });
    std::vector<bool> kept;
    for (const FigureRepeat& repeat : material.repeats) {
        kept.push_back(repeat.beat_frames.size() == most->first);
    }
    keep_repeats(kept, "has another number of beats than most repeats", material);
}

}  // namespace

std::string_view cmu_attribution() noexcept {
    return "The data used in this project was obtained from mocap.cs.cmu.edu. The database was "
           "created with funding from NSF EIA-0196217.";
}

Expected<TrainingMaterial> load_material(const FigureTrainingPlan& plan) {
    const Expected<std::map<std::string, fs::path>> files = clips_by_take(plan);
    if (!files) {
        return fail(files.error());
    }
    const Expected<Tables> tables = load_tables(plan);
    if (!tables) {
        return fail(tables.error());
    }
    Collector collector(plan, *tables, *files);
    for (const FigureLabel& label : tables->labels) {
        if (!is_wanted(label, plan)) {
            continue;
        }
        if (auto ok = collector.add(label); !ok) {
            return fail(std::move(ok.error()));
        }
    }
    TrainingMaterial& material = collector.material();
    if (material.repeats.empty()) {
        return fail(
            fmt::format("{}: no {} of the {} to learn from ({} labelled, none fit); check "
                        "figure, role, split and confidence",
                        labels_name(plan),
                        plan.figure,
                        kRoleNames[static_cast<std::size_t>(plan.role)],
                        material.uses.size()));
    }
    // Lengths can differ only where the music decided them, or each clip's own feet.
    if (plan.music || plan.labels.empty()) {
        keep_common_length(material);
    }
    return std::move(material);
}

Expected<FigureTrainingReport> train_figure(const FigureTrainingPlan& plan) {
    Expected<TrainingMaterial> material = load_material(plan);
    if (!material) {
        return fail(std::move(material.error()));
    }
    // After load_material, so that only repeats of the common length take part.
    keep_repeats(of_common_turn(material->clips, material->repeats),
                 "turns otherwise than most repeats",
                 *material);
    FigureTrainingOptions options;
    options.name = plan.figure;
    options.dance = plan.dance;
    options.role = plan.role;
    options.features = plan.features;
    options.attribution = plan.attribution;
    options.beats = beats_of(*material);
    options.states = plan.states;
    options.baum_welch_iterations = plan.baum_welch_iterations;
    options.covariance = plan.covariance;
    options.start = plan.start;
    Expected<FigureTrainingResult> result =
        train_figure(material->clips, material->repeats, options);
    if (!result) {
        return fail(std::move(result.error()));
    }
    FigureTrainingReport report{std::move(result->model),
                                result->log_likelihood,
                                std::move(material->uses),
                                std::move(material->warnings)};
    // A dance this fast is more likely a wrong frame rate; only a warning, for it may be right.
    if (report.model.learnt_tempo.bpm() > kFastestDance) {
        report.warnings.push_back(
            fmt::format("learnt at {:.0f} BPM, faster than people dance: is the frame rate right? "
                        "(--fps)",
                        report.model.learnt_tempo.bpm()));
    }
    return report;
}

}  // namespace raks::motion
