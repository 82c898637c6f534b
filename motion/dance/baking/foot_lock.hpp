#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/dance/baking/contact_windows.hpp"
#include "motion/dance/body/leg_ik.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// A contact to be kept.
struct PlannedContact {
    ContactWindow window;
    std::optional<glm::vec2> place;  ///< of the ball on the floor (x, z); none: where it is
    glm::vec2 aside{};               ///< from there; metres
    bool is_mean = false;  ///< of repeats that step at different moments (step_timing.hpp)
    /// Sample at which the foot comes to rest by itself, before or after the window's first.
    std::optional<double> arrival;
    /// How far the step before it shall go at the speed of one reach, 0 to 1 (step_timing.hpp).
    double reach = 0.0;
};

/// Plants the feet of a closed figure: the hips' height is set so that the standing foot is on the
/// floor, the ball of a foot in contact stays at its place, or where it is on average (the foot may
/// turn about it), toes bend by the ball when the heel rises, no part of a sole goes below the
/// floor, and the hips sink where a leg would not reach. Sets foot_contact. (Kovar, Schreiner,
/// Gleicher 2002, "Footskate cleanup for motion capture editing".)
///
/// The feet are `stepping`, by Side, a place a pose: they may be danced otherwise than `poses`
/// above the hips, so that a repeat may sway more, and its steps stay steps. They are brought into
/// time with the contacts first, and evened once they are planted (step_timing.hpp). What the lock
/// moves an ankle by goes over from one contact to the next during the flight, which is the
/// smoothest that leaves and meets both as they are (flight.hpp): nothing kinks where a foot is let
/// go or taken up. `samples_per_beat` paces heights, flights and hips. Threads: workers. Real-time:
/// no.
void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<PlannedContact>, 2>& contacts,
               double samples_per_beat,
               const std::array<std::vector<FootTarget>, 2>& stepping,
               std::vector<Pose>& poses);

}  // namespace raks::motion
