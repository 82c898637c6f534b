#include "training/cells/cell_training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/parallel.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "training/cells/cell_reach.hpp"
#include "training/cells/laid_arms.hpp"
#include "training/cells/prepared_take.hpp"
#include "training/cells/state_ties.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/training_plan.hpp"

namespace raks::motion {
namespace {

// Beats of a table that are read: some are cut. What is learnt of them stays under half a GB.
constexpr std::size_t kMostBeats = 2 * kMostCells;
constexpr double kAroundStretch = 1.0;  // seconds of a clip around what is learnt

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

Expected<std::vector<TakeBeats>> wanted_takes(const CellTrainingPlan& plan) {
    std::vector<TakeBeats> takes = by_take(plan.beats);
    for (const std::string& name : plan.without) {
        const auto found = std::find_if(
            takes.begin(), takes.end(), [&](const TakeBeats& each) { return each.take == name; });
        if (found == takes.end()) {
            return fail(fmt::format("{}: cannot be left out, the table has no such take", name));
        }
        takes.erase(found);
    }
    std::size_t used = 0;
    for (const TakeBeats& take : takes) {
        used += static_cast<std::size_t>(
            std::count_if(take.beats.begin(), take.beats.end(), [](const TakeBeat& beat) {
                return beat.is_used;
            }));
    }
    if (used > kMostBeats) {
        return fail(
            fmt::format("the table has {} beats to be danced, a dance holds {} at most; "
                        "leave takes out, or set their column \"used\" to 0",
                        used,
                        kMostCells));
    }
    return takes;
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

// The part of a clip that a stretch is learnt from, with the frames of its beats in that part: a
// long clip is not filtered anew for each of its stretches.
std::pair<TrainingClip, FigureRepeat> part_of_clip(const PreparedTake& take,
                                                   const TakeStretch& stretch) {
    const TrainingClip& whole = take.clip;
    const double around = kAroundStretch * whole.frames_per_second;
    const auto first = static_cast<std::ptrdiff_t>(
        std::floor(std::max(0.0, stretch.beat_frames.front() - around)));
    const auto last = static_cast<std::ptrdiff_t>(std::ceil(std::min(
        static_cast<double>(whole.poses.size() - 1), stretch.beat_frames.back() + around)));
    TrainingClip part;
    part.name = whole.name;
    part.frames_per_second = whole.frames_per_second;
    part.hips_height = whole.hips_height;
    part.poses.assign(whole.poses.begin() + first, whole.poses.begin() + last + 1);
    part.feet.assign(whole.feet.begin() + first, whole.feet.begin() + last + 1);
    FigureRepeat repeat;
    for (const double frame : stretch.beat_frames) {
        repeat.beat_frames.push_back(frame - static_cast<double>(first));
    }
    return {std::move(part), std::move(repeat)};
}

Expected<FigureModel> learn_stretch(const PreparedTake& take,
                                    const TakeStretch& stretch,
                                    const CellTrainingPlan& plan) {
    const auto [clip, repeat] = part_of_clip(take, stretch);
    FigureTrainingOptions options;
    options.name = fmt::format(
        "{}_{:.0f}", take.clip.name, stretch.beat_frames[1] / take.clip.frames_per_second);
    options.dance = plan.dance;
    options.attribution = plan.licence;
    options.beats = static_cast<int>(stretch.beat_frames.size()) - 1;
    options.samples_per_beat = kCellSamples;
    options.states = kStatesPerBeat * options.beats;
    options.contact_bins =
        std::size_t{kContactBinsPerBeat} * static_cast<std::size_t>(options.beats);
    options.low_pass_hz = kTakeLowPassHz;
    auto learnt = train_figure(std::span(&clip, 1), std::span(&repeat, 1), options);
    if (!learnt) {
        return fail(std::move(learnt.error()).in(take.clip.name));
    }
    tie_variances(learnt->model);
    return std::move(learnt->model);
}

// What one take gives.
struct LearntTake {
    TakeCut cut;
    std::vector<FigureModel> models;  // by stretch
    std::vector<double> jerks;
    std::size_t laid = 0;  // beats that were given other arms
    std::vector<std::string> warnings;
};

// Gives a take that is ready to be cut, by its name; adds warnings. Called on several threads.
using TakeReader =
    std::function<Expected<PreparedTake>(const std::string&, std::vector<std::string>&)>;

Expected<LearntTake> learn_take(const TakeReader& reader,
                                const TakeBeats& own,
                                const CellTrainingPlan& plan) {
    LearntTake learnt;
    auto take = reader(own.take, learnt.warnings);
    if (!take) {
        return fail(std::move(take.error()));
    }
    auto cut = cut_take(*take, own.beats);
    if (cut && plan.lays_arms) {
        learnt.laid = lay_arms(*take, own.beats, cut->fates);
        cut = cut_take(*take, own.beats);
    }
    if (!cut) {
        return fail(std::move(cut.error()));
    }
    learnt.cut = std::move(*cut);
    for (const TakeStretch& stretch : learnt.cut.stretches) {
        auto model = learn_stretch(*take, stretch, plan);
        if (!model) {
            return fail(std::move(model.error()));
        }
        learnt.models.push_back(std::move(*model));
    }
    if (!learnt.cut.cells.empty()) {
        learnt.jerks = jerk_samples(*take, danced_frames(*take, own.beats, learnt.cut));
    }
    return learnt;
}

// All takes of a plan, learnt and put together.
class CellTraining {
 public:
    CellTraining(const CellTrainingPlan& plan, TakeReader reader)
        : plan_(plan), reader_(std::move(reader)) {}

    // `names`: of the takes that there are.
    Expected<CellTrainingReport> run(const std::set<std::string>& names) {
        if (auto ok = learn(names); !ok) {
            return fail(std::move(ok.error()));
        }
        if (auto ok = check_count(); !ok) {
            return fail(std::move(ok.error()));
        }
        const JerkReport jerk = jerk_of_samples(std::move(jerks_));
        report_.people_jerk_rms = jerk.rms;
        report_.people_jerk_p999 = jerk.p999;
        join();
        if (report_.dance.graph.arcs.empty()) {
            return fail(
                fmt::format("of {} beats that can be danced none leads back to another; "
                            "label more, or more takes",
                            cells_.size()));
        }
        drop_takes_without_cells();
        give_landings(report_.dance);
        if (auto ok = validate(report_.dance.graph); !ok) {
            return fail(std::move(ok.error()).in("the learnt dance"));
        }
        return std::move(report_);
    }

 private:
    Expected<void> learn(const std::set<std::string>& names) {
        auto takes = wanted_takes(plan_);
        if (!takes) {
            return fail(std::move(takes.error()));
        }
        for (const TakeBeats& own : *takes) {
            if (!names.contains(own.take)) {
                return fail(fmt::format("{}: is not among the clips; the table's line {} names it",
                                        own.take,
                                        own.beats.front().line));
            }
        }
        std::vector<std::optional<Expected<LearntTake>>> learnt(takes->size());
        run_parallel(takes->size(), plan_.threads, [&](std::size_t i) {
            const TakeBeats& own = (*takes)[i];
            const bool is_danced = std::any_of(own.beats.begin(),
                                               own.beats.end(),
                                               [](const TakeBeat& beat) { return beat.is_used; });
            learnt[i] =
                is_danced ? learn_take(reader_, own, plan_) : Expected<LearntTake>(LearntTake{});
        });
        report_.dance.dance = plan_.dance;
        report_.dance.licence = plan_.licence;
        for (std::size_t i = 0; i < learnt.size(); ++i) {
            if (!*learnt[i]) {
                return fail(std::move((*learnt[i]).error()));
            }
            add((*takes)[i], std::move(**learnt[i]));
            learnt[i].reset();
        }
        return {};
    }

    // Puts a take's cells and chains behind those of the takes before it.
    void add(const TakeBeats& own, LearntTake&& learnt) {
        TakeUse& use = report_.takes.emplace_back(TakeUse{own.take, {}, learnt.laid});
        learnt.cut.fates.resize(own.beats.size(), BeatFate::unused);
        for (const BeatFate fate : learnt.cut.fates) {
            ++use.beats[static_cast<std::size_t>(fate)];
        }
        const std::size_t first = report_.dance.takes.size();
        for (CellSource& source : learnt.cut.cells) {
            const TakeStretch& stretch = learnt.cut.stretches[source.cell.take];
            const std::size_t beat = stretch.first + source.cell.beat - 1;
            lengths_.push_back(own.beats[beat + 1].time - own.beats[beat].time);
            source.cell.take = static_cast<std::uint16_t>(source.cell.take + first);
            cells_.push_back(source);
            origins_.push_back(report_.takes.size() - 1);
        }
        for (FigureModel& model : learnt.models) {
            report_.dance.takes.push_back(std::move(model));
        }
        report_.landings += learnt.cut.landings;
        report_.far_landings += learnt.cut.far_landings;
        jerks_.insert(jerks_.end(), learnt.jerks.begin(), learnt.jerks.end());
        std::move(
            learnt.warnings.begin(), learnt.warnings.end(), std::back_inserter(report_.warnings));
    }

    // Whether there are enough cells, and not too many.
    [[nodiscard]] Expected<void> check_count() const {
        if (cells_.size() > kMostCells) {
            return fail(
                fmt::format("{} beats can be danced, a dance holds {} at most; leave takes "
                            "out, or set their column \"used\" to 0",
                            cells_.size(),
                            kMostCells));
        }
        if (!cells_.empty()) {
            return {};
        }
        std::string why;
        for (std::size_t fate = 0; fate < kBeatFates; ++fate) {
            std::size_t beats = 0;
            for (const TakeUse& use : report_.takes) {
                beats += use.beats[fate];
            }
            if (beats > 0) {
                why += fmt::format("{}{} {}", why.empty() ? "" : ", ", beats, kBeatFateNames[fate]);
            }
        }
        return fail(
            fmt::format("no beat of the takes can be danced ({}); a beat lasts {:g} to "
                        "{:g} s: of slower music label the half beats, of faster music "
                        "every other one",
                        why,
                        kShortestCell,
                        kLongestCell));
    }

    // Joins the cells, keeps what hangs together, and learns repeats among it as one.
    void join() {
        const double beat_seconds = std::accumulate(lengths_.begin(), lengths_.end(), 0.0) /
                                    static_cast<double>(lengths_.size());
        // At the dance's tempo a long cell is danced faster than in its take.
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            cells_[i].cell.energy *= static_cast<float>(lengths_[i] / beat_seconds);
        }
        ArcOptions arcs = plan_.arcs;
        arcs.threads = plan_.threads;
        JoinedCells joined = join_cells(cells_, arcs);
        report_.wide_joins = joined.wide_joins;
        ReachedCells reached = reached_cells(std::move(joined.graph));
        std::vector<CellSource> kept;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const CellFate fate = reached.fates[i];
            if (fate == CellFate::stays) {
                kept.push_back(cells_[i]);
                continue;
            }
            TakeUse& use = report_.takes[origins_[i]];
            --use.beats[static_cast<std::size_t>(BeatFate::danced)];
            ++use.beats[static_cast<std::size_t>(fate == CellFate::apart ? BeatFate::apart
                                                                         : BeatFate::far)];
        }
        const std::vector<CellRepeats> groups = find_cell_repeats(kept, plan_.ties);
        report_.tied_states = tie_states(groups, kept, report_.dance.takes);
        report_.figures = groups.size();
        for (const CellRepeats& group : groups) {
            report_.tied_cells += group.size();
        }
        report_.has_rests = reached.has_rests;
        report_.has_endings = reached.has_endings;
        report_.dance.graph = std::move(reached.graph);
        report_.dance.graph.beat_seconds = beat_seconds;
    }

    void drop_takes_without_cells() {
        std::vector<bool> is_danced(report_.dance.takes.size());
        for (const Cell& cell : report_.dance.graph.cells) {
            is_danced[cell.take] = true;
        }
        std::vector<std::uint16_t> numbers(is_danced.size());
        std::vector<FigureModel> left;
        for (std::size_t i = 0; i < is_danced.size(); ++i) {
            numbers[i] = static_cast<std::uint16_t>(left.size());
            if (is_danced[i]) {
                const FigureModel& model = report_.dance.takes[i];
                report_.dance.graph.takes.push_back({model.name, model.beats});
                left.push_back(std::move(report_.dance.takes[i]));
            }
        }
        for (Cell& cell : report_.dance.graph.cells) {
            cell.take = numbers[cell.take];
        }
        report_.dance.takes = std::move(left);
    }

    const CellTrainingPlan& plan_;
    TakeReader reader_;
    CellTrainingReport report_;
    std::vector<CellSource> cells_;
    std::vector<std::size_t> origins_;  // by cell: index in the report's takes
    std::vector<double> jerks_;
    std::vector<double> lengths_;  // by cell, seconds
};

}  // namespace

std::size_t TakeUse::labelled() const noexcept {
    return std::accumulate(beats.begin(), beats.end(), std::size_t{0});
}

Expected<CellTrainingReport> train_cells(const CellTrainingPlan& plan) {
    FigureTrainingPlan files;
    files.clips = plan.clips;
    const auto paths = clips_by_take(files);
    if (!paths) {
        return fail(paths.error());
    }
    std::set<std::string> names;
    for (const auto& [name, path] : *paths) {
        names.insert(name);
    }
    return CellTraining(plan,
                        [&](const std::string& take, std::vector<std::string>& warnings) {
                            return prepare_take(paths->at(take), plan.units, warnings);
                        })
        .run(names);
}

Expected<CellTrainingReport> train_cells(const CellTrainingPlan& plan,
                                         std::span<const TrainingClip> clips) {
    std::set<std::string> names;
    for (const TrainingClip& clip : clips) {
        names.insert(clip.name);
    }
    return CellTraining(plan,
                        [&](const std::string& take, std::vector<std::string>& /*warnings*/) {
                            return prepare_take(*std::find_if(
                                clips.begin(), clips.end(), [&](const TrainingClip& clip) {
                                    return clip.name == take;
                                }));
                        })
        .run(names);
}

}  // namespace raks::motion
