#include "training/cells/cell_training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "motion/figures/foot_events.hpp"
#include "motion/figures/motion_features.hpp"
#include "training/cells/take_moments.hpp"
#include "training/figures/repeat_features.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::motion {
namespace {

// A cell lasts as long as a beat of music that is danced to: 67 to 188 BPM.
constexpr double kShortestCell = 0.32;
constexpr double kLongestCell = 0.90;
// Mean speed of the joints about the hips, metres a second, under which nobody dances.
constexpr double kIdleSpeed = 0.12;
// Beats of one stretch: what a figure may have.
constexpr std::size_t kLongestStretch = 60;
constexpr double kLowPassHz = 10.0;

// Labelled beats of one take, in their order.
struct TakeBeats {
    std::string take;
    std::vector<TakeBeat> beats;
};

std::vector<TakeBeats> by_take(const std::vector<TakeBeat>& beats) {
    std::vector<TakeBeats> takes;
    for (const TakeBeat& beat : beats) {
        const auto found = std::find_if(takes.begin(), takes.end(), [&](const TakeBeats& each) {
            return each.take == beat.take;
        });
        TakeBeats& own =
            found != takes.end() ? *found : takes.emplace_back(TakeBeats{beat.take, {}});
        own.beats.push_back(beat);
    }
    return takes;
}

// Rows [first, last] of a take's beats.
struct Stretch {
    std::size_t first = 0;
    std::size_t last = 0;
};

// Runs of beats that are danced, with a beat on either side where there is one: the trajectory of a
// stretch is not to be trusted at its ends.
std::vector<Stretch> stretches_of(const std::vector<TakeBeat>& beats) {
    std::vector<Stretch> stretches;
    const std::size_t end = beats.size() - 1;  // the last row only ends a beat
    for (std::size_t i = 0; i < end;) {
        if (!beats[i].is_used) {
            ++i;
            continue;
        }
        std::size_t last = i;
        while (last < end && beats[last].is_used && last - i < kLongestStretch - 2) {
            ++last;
        }
        stretches.push_back({i > 0 ? i - 1 : 0, std::min(last + 1, end)});
        i = last;
    }
    return stretches;
}

// One clip, ready for cutting.
struct PreparedTake {
    TrainingClip clip;
    std::vector<TakeMoment> moments;
    std::vector<double> headings;  // of the hips, by frame
};

Expected<PreparedTake> prepare(const std::filesystem::path& path,
                               const ClipUnits& units,
                               std::vector<std::string>& warnings) {
    auto clip = load_clip(path, units, warnings);
    if (!clip) {
        return fail(std::move(clip.error()));
    }
    PreparedTake take;
    take.clip = std::move(*clip);
    std::vector<Pose> poses = take.clip.poses;
    bridge_faults(poses, take.clip.faults);
    poses = filtered(poses, low_pass_taps(kLowPassHz, take.clip.frames_per_second));
    std::array<std::vector<bool>, 2> planted;
    for (const Side side : kSides) {
        planted[static_cast<std::size_t>(side)] =
            toe_contacts(take.clip.feet, side, take.clip.frames_per_second);
    }
    FigureModel size;
    size.source_hips_height = take.clip.hips_height;
    take.moments = moments_of(poses, take.clip.frames_per_second, source_body(size), planted);
    return take;
}

// The moment nearest to a time of the clip.
const TakeMoment& moment_at(const PreparedTake& take, double seconds) {
    const double frame = std::round(seconds * take.clip.frames_per_second);
    return take.moments[std::min(static_cast<std::size_t>(frame), take.moments.size() - 1)];
}

// How the hips go over a cell, in the frame of its start.
void measure(const PreparedTake& take, double from, double to, Cell& cell) {
    const double fps = take.clip.frames_per_second;
    const auto frame_of = [&](double seconds) {
        return std::min(static_cast<std::size_t>(std::lround(seconds * fps)),
                        take.moments.size() - 1);
    };
    const std::size_t first = frame_of(from);
    const std::size_t last = frame_of(to);
    double heading = 0.0;
    double speed = 0.0;
    glm::dvec2 way{};
    for (std::size_t frame = first; frame < last; ++frame) {
        const TakeMoment& moment = take.moments[frame];
        const double c = std::cos(heading);
        const double s = std::sin(heading);
        way += glm::dvec2(c * moment.hips_velocity.x + s * moment.hips_velocity.y,
                          -s * moment.hips_velocity.x + c * moment.hips_velocity.y) /
               fps;
        heading += moment.turning / fps;
        speed += moment.speed();
    }
    cell.way = glm::vec2(way);
    cell.turn = static_cast<float>(heading);
    cell.energy =
        static_cast<float>(speed / std::max<double>(1.0, static_cast<double>(last - first)));
    cell.speed_at_end = static_cast<float>(take.moments[last].speed());
}

// Every state with the same variances, so that the file holds means alone and no state of a single
// example is trusted more than another.
void tie_variances(FigureModel& model) {
    for (PartModel& part : model.parts) {
        for (auto member : {&FigureState::variance,
                            &FigureState::delta_variance,
                            &FigureState::delta_delta_variance}) {
            std::vector<double> mean(part.dimension());
            for (const FigureState& state : part.states) {
                for (std::size_t d = 0; d < mean.size(); ++d) {
                    mean[d] += (state.*member)[d] / static_cast<double>(part.states.size());
                }
            }
            for (FigureState& state : part.states) {
                state.*member = mean;
            }
        }
    }
}

Expected<FigureModel> learn_stretch(const PreparedTake& take,
                                    const TakeBeats& own,
                                    const Stretch& stretch,
                                    const CellTrainingPlan& plan) {
    FigureRepeat repeat;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
        double frame = own.beats[i].time * take.clip.frames_per_second;
        // A beat that only gives the motion behind the last one may end with the clip.
        if (i == stretch.last && !own.beats[i].is_used) {
            frame = std::min(frame, static_cast<double>(take.clip.poses.size() - 1));
        }
        repeat.beat_frames.push_back(frame);
    }
    FigureTrainingOptions options;
    options.name = fmt::format("{}_{:.0f}", own.take, own.beats[stretch.first].time);
    options.dance = plan.dance;
    options.attribution = plan.licence;
    options.beats = static_cast<int>(stretch.last - stretch.first);
    options.samples_per_beat = kCellSamples;
    options.states = kStatesPerBeat * options.beats;
    options.contact_bins =
        std::size_t{kContactBinsPerBeat} * static_cast<std::size_t>(options.beats);
    options.low_pass_hz = kLowPassHz;
    auto learnt = train_figure(std::span(&take.clip, 1), std::span(&repeat, 1), options);
    if (!learnt) {
        return fail(std::move(learnt.error()).in(own.take));
    }
    tie_variances(learnt->model);
    return std::move(learnt->model);
}

// The cells of one stretch; counts what is left out.
void cut(const PreparedTake& take,
         const TakeBeats& own,
         const Stretch& stretch,
         std::size_t number,
         TakeUse& use,
         std::vector<CellSource>& cells) {
    for (std::size_t i = stretch.first + 1; i + 1 < stretch.last; ++i) {
        const double from = own.beats[i].time;
        const double to = own.beats[i + 1].time;
        if (!own.beats[i].is_used) {
            continue;
        }
        if (to - from < kShortestCell || to - from > kLongestCell) {
            ++use.odd;
            continue;
        }
        CellSource source;
        source.cell.take = static_cast<std::uint16_t>(number);
        source.cell.beat = static_cast<std::uint16_t>(i - stretch.first);
        source.cell.is_second_half = own.beats[i].half == 2;
        measure(take, from, to, source.cell);
        if (source.cell.energy < static_cast<float>(kIdleSpeed)) {
            ++use.idle;
            continue;
        }
        source.start = moment_at(take, from);
        source.end = moment_at(take, to);
        cells.push_back(source);
        ++use.cells;
    }
}

}  // namespace

Expected<CellTrainingReport> train_cells(const CellTrainingPlan& plan) {
    FigureTrainingPlan files;
    files.clips = plan.clips;
    const auto paths = clips_by_take(files);
    if (!paths) {
        return fail(paths.error());
    }
    CellTrainingReport report;
    report.dance.dance = plan.dance;
    report.dance.licence = plan.licence;
    std::vector<CellSource> cells;
    std::vector<CellTake> takes;
    double seconds = 0.0;
    std::size_t beats = 0;
    for (const TakeBeats& own : by_take(plan.beats)) {
        const auto path = paths->find(own.take);
        if (path == paths->end()) {
            return fail(fmt::format("{}: is not among the clips; the table's line {} names it",
                                    own.take,
                                    own.beats.front().line));
        }
        TakeUse& use = report.takes.emplace_back(TakeUse{own.take, own.beats.size()});
        const std::vector<Stretch> stretches = stretches_of(own.beats);
        if (stretches.empty()) {
            continue;
        }
        const auto take = prepare(path->second, plan.units, report.warnings);
        if (!take) {
            return fail(take.error());
        }
        for (const Stretch& stretch : stretches) {
            if (stretch.last - stretch.first < 3) {
                continue;  // no beat between its ends
            }
            auto model = learn_stretch(*take, own, stretch, plan);
            if (!model) {
                return fail(std::move(model.error()));
            }
            cut(*take, own, stretch, takes.size(), use, cells);
            takes.push_back({model->name, model->beats});
            report.dance.takes.push_back(std::move(*model));
            seconds += own.beats[stretch.last].time - own.beats[stretch.first].time;
            beats += stretch.last - stretch.first;
        }
    }
    if (cells.empty()) {
        return fail("no beat of the takes can be danced; check times and the column \"used\"");
    }
    CellArcs joined = join_cells(cells, plan.arcs);
    report.dance.graph = std::move(joined.graph);
    report.dance.graph.takes = std::move(takes);
    report.dance.graph.beat_seconds = seconds / static_cast<double>(beats);
    sort_energies(report.dance.graph);
    report.apart = joined.left_out;
    report.connected = joined.connected;
    if (auto ok = validate(report.dance.graph); !ok) {
        return fail(std::move(ok.error()).in("the learnt dance"));
    }
    return report;
}

}  // namespace raks::motion
