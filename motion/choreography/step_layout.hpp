#pragma once

#include <array>
#include <vector>

#include "motion/choreography/repeat_plan.hpp"

#include <glm/vec2.hpp>

/// When and where feet step: section 3 of the evaluation in docs/reference/choreography.md.
namespace raks::motion {

/// One step of one foot; metres and radians in the world, places on the floor.
struct PlacedStep {
    static constexpr double kSlide = 0.01;  ///< m: one that rises no more slides

    double start = 0.0;  ///< beat at which the foot leaves the floor
    double end = 0.0;    ///< and rests again
    glm::dvec2 from{};
    glm::dvec2 to{};
    double from_yaw = 0.0;
    double to_yaw = 0.0;
    double lift = 0.0;  ///< of the ball, at most
    FootLanding on = FootLanding::ball;
    double leaves = 0.0;  ///< pitch when it leaves the floor

    [[nodiscard]] bool slides() const noexcept { return lift <= kSlide; }
};

struct WeightChange {
    double at = 0.0;    ///< beat, the change's middle
    double left = 0.5;  ///< what is then on the left foot, [0, 1]
};

/// The steps of all repeats, by Side and by their ends.
struct StepLayout {
    std::array<std::vector<PlacedStep>, 2> steps;
    std::vector<WeightChange> weights;        ///< as written: not by time
    std::array<glm::dvec2, 2> first_place{};  ///< of the feet before any step
    std::array<double, 2> first_yaw{};
};

/// Lays out the steps of all repeats; a foot leaves the floor no sooner than it has landed.
[[nodiscard]] StepLayout place_steps(const RepeatPlan& plan);

inline constexpr double kPeelTime = 0.28;  ///< beats before a step in which the heel rises

/// Pitch of a foot as it comes down, radians; > 0: heel up.
[[nodiscard]] double landing_pitch(FootLanding on) noexcept;
/// Pitch of a foot on the floor after a step (nullptr: none yet), before the next one is felt.
[[nodiscard]] double settled_pitch(const PlacedStep* step, double beat) noexcept;
/// Beats that a foot has on the floor before a step.
[[nodiscard]] double time_standing(const PlacedStep* before, const PlacedStep& step) noexcept;

}  // namespace raks::motion
