#include "motion/dance/landing_delay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

constexpr double kFramesPerSecond = 60.0;
constexpr int kLeastRepeats = 3;    // that a landing was learnt from
constexpr double kEarliest = -0.4;  // beats: a landing belongs to the count from here on, as learnt

constexpr double kMostAimed = 0.3;  // beats

using Feet = std::vector<std::array<SourceFoot, 2>>;

/// Both feet by frame, from `margin` beats before count 1 to as much after the end.
Feet feet_of(const FigureModel& model, const FigurePassage& passage, const Skeleton& skeleton) {
    const double beats_a_frame = model.learnt_tempo.beats_per_second() / kFramesPerSecond;
    Feet feet;
    for (double beat = -FigurePassage::kMargin; beat <= model.beats + FigurePassage::kMargin;
         beat += beats_a_frame) {
        Pose pose;
        passage.at(beat, pose);
        const WorldPose world = world_pose(skeleton, pose);
        std::array<SourceFoot, 2>& both = feet.emplace_back();
        for (const Side side : kSides) {
            both[static_cast<std::size_t>(side)] = {
                glm::dvec3(world.position(on_side(Bone::left_foot, side))),
                glm::dvec3(toe_tip(skeleton, world, side))};
        }
    }
    return feet;
}

/// A step that came down where people's does.
struct Step {
    Side side = Side::left;
    std::size_t count = 0;  // from 0
    double late = 0.0;      // beats
};

std::vector<Step> steps_of(const FigureModel& model,
                           const FigurePassage& passage,
                           const Skeleton& skeleton) {
    const Feet feet = feet_of(model, passage, skeleton);
    const double beats_a_frame = model.learnt_tempo.beats_per_second() / kFramesPerSecond;
    std::vector<Step> steps;
    for (const Side side : kSides) {
        const auto& offsets = model.landings[static_cast<std::size_t>(side)];
        for (const double frame : landings(feet, side, kFramesPerSecond)) {
            const double beat = frame * beats_a_frame - FigurePassage::kMargin;
            const auto count = static_cast<std::ptrdiff_t>(std::floor(beat - kEarliest));
            if (count < 0 || count >= std::ssize(offsets)) {
                continue;
            }
            const LandingOffset& offset = offsets[static_cast<std::size_t>(count)];
            const bool is_first = steps.empty() || steps.back().side != side ||
                                  steps.back().count != static_cast<std::size_t>(count);
            if (offset.repeats >= kLeastRepeats && is_first) {
                steps.push_back({side,
                                 static_cast<std::size_t>(count),
                                 beat - static_cast<double>(count) - offset.median.count()});
            }
        }
    }
    return steps;
}

}  // namespace

Nanos landing_delay(const FigureModel& model,
                    const FigurePassage& passage,
                    const Skeleton& skeleton) {
    std::vector<double> late;  // beats
    for (const Step& step : steps_of(model, passage, skeleton)) {
        late.push_back(step.late);
    }
    if (late.empty()) {
        return Nanos(0);
    }
    const auto middle = late.begin() + std::ssize(late) / 2;
    std::nth_element(late.begin(), middle, late.end());
    return nanos_from_seconds(*middle * model.learnt_tempo.seconds_per_beat());
}

void aim_landings(const FigureModel& model,
                  const FigurePassage& passage,
                  const Skeleton& skeleton,
                  FigureLandings& aimed) {
    for (const Step& step : steps_of(model, passage, skeleton)) {
        const auto s = static_cast<std::size_t>(step.side);
        const double learnt = model.landings[s][step.count].median.count();
        Beats& here = aimed[s][step.count].median;
        here =
            Beats(std::clamp(here.count() - step.late, learnt - kMostAimed, learnt + kMostAimed));
    }
}

}  // namespace raks::motion
