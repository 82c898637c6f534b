#pragma once

#include <array>
#include <vector>

#include "motion/choreography/repeat_plan.hpp"

#include <glm/vec2.hpp>

/// Step layout: when and where feet step over all repeats; section 3 of the evaluation in
/// docs/reference/choreography.md.
namespace raks::motion {

/// One step of one foot; metres and radians in the world, places on the floor.
struct PlacedStep {
    static constexpr double kSlide = 0.01;  ///< metres; a step lifted no more than this slides

    double start = 0.0;                  ///< beat at which the foot leaves the floor
    double end = 0.0;                    ///< beat at which it rests again
    glm::dvec2 from{};                   ///< place of the ball before
    glm::dvec2 to{};                     ///< place of the ball after
    double from_yaw = 0.0;               ///< direction of the toes before
    double to_yaw = 0.0;                 ///< direction of the toes after
    double lift = 0.0;                   ///< greatest height of the ball
    FootLanding on = FootLanding::ball;  ///< how it lands
    double leaves = 0.0;                 ///< pitch as it leaves the floor; > 0: heel up

    /// Whether it stays on the floor.
    [[nodiscard]] bool slides() const noexcept { return lift <= kSlide; }
};

/// A shift of the weight between the feet.
struct WeightChange {
    double at = 0.0;    ///< beat of its middle
    double left = 0.5;  ///< share on the left foot after it, [0, 1]
};

/// The steps of all repeats.
struct StepLayout {
    std::array<std::vector<PlacedStep>, 2> steps;  ///< by Side, in order of their ends
    std::vector<WeightChange> weights;             ///< in the order written, not by time
    std::array<glm::dvec2, 2> first_place{};       ///< of the feet before any step
    std::array<double, 2> first_yaw{};             ///< direction of the toes before any step
};

/// Lays out the steps of all repeats; a foot leaves the floor no earlier than it has landed.
/// Threads: any. Real-time: no.
[[nodiscard]] StepLayout place_steps(const RepeatPlan& plan);

inline constexpr double kPeelTime = 0.28;  ///< beats before a step in which the heel rises

/// Pitch of a foot as it lands, radians; > 0: heel up.
[[nodiscard]] double landing_pitch(FootLanding on) noexcept;
/// Pitch of a foot on the floor after a step (null: before any), before the heel peels for the next
/// one.
[[nodiscard]] double settled_pitch(const PlacedStep* step, double beat) noexcept;
/// Beats that a foot stands between two steps; kPeelTime before the first one.
[[nodiscard]] double time_standing(const PlacedStep* before, const PlacedStep& step) noexcept;

}  // namespace raks::motion
