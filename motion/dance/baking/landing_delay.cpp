#include "motion/dance/baking/landing_delay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/statistics.hpp"
#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

constexpr double kFramesPerSecond = 60.0;  // at which passages are sampled to find their landings
constexpr int kLeastRepeats = 3;           // that must have shown a landing

constexpr double kMostAimed = 0.3;  // beats from the learnt landing

using FeetByFrame = std::vector<std::array<SourceFoot, 2>>;

/// Both feet by frame, from kMargin before count 1 to kMargin after the end: the detector filters
/// the speed, so it needs motion around the figure.
FeetByFrame feet_of(const FigureModel& model,
                    const FigurePassage& passage,
                    const Skeleton& skeleton,
                    double beats_a_frame) {
    FeetByFrame feet;
    for (double beat = -FigurePassage::kMargin; beat <= model.beats + FigurePassage::kMargin;
         beat += beats_a_frame) {
        Pose pose;
        passage.at(beat, pose);
        const WorldPose world = world_body(skeleton, pose);
        std::array<SourceFoot, 2>& both = feet.emplace_back();
        for (const Side side : kSides) {
            both[static_cast<std::size_t>(side)] = {
                glm::dvec3(world.position(on_side(Bone::left_foot, side))),
                glm::dvec3(toe_tip(skeleton, world, side))};
        }
    }
    return feet;
}

/// A detected landing that was matched with a learnt one.
struct Step {
    Side side = Side::left;
    std::size_t count = 0;  // of the learnt landing, from 0
    double late = 0.0;      // beats after the learnt landing
};

/// The count whose learnt landing lies nearest to `beat`, less than half a beat away.
std::optional<std::size_t> nearest_count(const FigureModel& model, Side side, double beat) {
    constexpr double kFarthest = 0.5;  // beats
    const auto& offsets = model.landings[static_cast<std::size_t>(side)];
    std::optional<std::size_t> nearest;
    double least = kFarthest;
    for (std::size_t count = 0; count < offsets.size(); ++count) {
        const LandingOffset& offset = offsets[count];
        const double away = std::abs(beat - static_cast<double>(count) - offset.median.count());
        if (offset.is_one(kLeastRepeats, model.repeats) && away < least) {
            least = away;
            nearest = count;
        }
    }
    return nearest;
}

/// The landings of a passage at `pace` (tempo danced / learnt), at most one a foot and count: of
/// two that match the same count the nearer one is kept.
std::vector<Step> steps_of(const FigureModel& model,
                           const FigurePassage& passage,
                           const Skeleton& skeleton,
                           double pace) {
    // The detector's limits are metres a second, so the passage is sampled at the danced speed.
    const double beats_a_frame = pace * model.learnt_tempo.beats_per_second() / kFramesPerSecond;
    const FeetByFrame feet = feet_of(model, passage, skeleton, beats_a_frame);
    std::vector<Step> steps;
    for (const Side side : kSides) {
        for (const double frame : landings(feet, side, kFramesPerSecond)) {
            const double beat = frame * beats_a_frame - FigurePassage::kMargin;
            const std::optional<std::size_t> count = nearest_count(model, side, beat);
            if (!count) {
                continue;
            }
            const Beats due = model.landings[static_cast<std::size_t>(side)][*count].median;
            const Step step{side, *count, beat - static_cast<double>(*count) - due.count()};
            const bool is_first =
                steps.empty() || steps.back().side != side || steps.back().count != *count;
            if (is_first) {
                steps.push_back(step);
            } else if (std::abs(step.late) < std::abs(steps.back().late)) {
                steps.back() = step;
            }
        }
    }
    return steps;
}

}  // namespace

FigureLandings single_landings(const FigureModel& model) {
    FigureLandings landings = model.landings;
    for (std::vector<LandingOffset>& counts : landings) {
        for (LandingOffset& offset : counts) {
            offset = offset.is_one(kLeastRepeats, model.repeats) ? offset : LandingOffset();
        }
    }
    return landings;
}

Nanos landing_delay(const FigureModel& model,
                    const FigurePassage& passage,
                    const Skeleton& skeleton) {
    std::vector<double> late;  // beats
    for (const Step& step : steps_of(model, passage, skeleton, 1.0)) {
        late.push_back(step.late);
    }
    if (late.empty()) {
        return Nanos(0);
    }
    // The median: one stray match does not move it.
    return nanos_from_seconds(upper_median(std::move(late)) *
                              model.learnt_tempo.seconds_per_beat());
}

void aim_landings(const FigureModel& model,
                  const FigurePassage& passage,
                  const Skeleton& skeleton,
                  double pace,
                  FigureLandings& aimed) {
    for (const Step& step : steps_of(model, passage, skeleton, pace)) {
        const auto s = static_cast<std::size_t>(step.side);
        const double learnt = model.landings[s][step.count].median.count();
        Beats& here = aimed[s][step.count].median;
        here =
            Beats(std::clamp(here.count() - step.late, learnt - kMostAimed, learnt + kMostAimed));
    }
}

}  // namespace raks::motion
