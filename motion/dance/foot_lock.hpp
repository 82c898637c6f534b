#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "motion/dance/contact_windows.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec2.hpp>

namespace raks::motion {

/// A contact to be kept.
struct PlannedContact {
    ContactWindow window;
    std::optional<glm::vec2> place;  ///< of the ball on the floor (x, z); none: where it is
    glm::vec2 aside{};               ///< from there; metres
};

/// Plants the feet of a closed figure: the hips' height is set so that the standing foot is on the
/// floor, the ball of a foot in contact stays at its place, or where it is on average (the foot may
/// turn about it), toes bend by the ball when the heel rises, no part of a sole goes below the
/// floor, and the hips sink where a leg would not reach. Sets foot_contact. (Kovar, Schreiner,
/// Gleicher 2002, "Footskate cleanup for motion capture editing".)
///
/// The feet are those of `stepping`, which may be danced otherwise than `poses` above the hips: so
/// a repeat may sway more, and its steps stay steps. What the lock moves an ankle by is carried
/// over each flight: the slide that it takes off by quintics that meet both contacts with their
/// speed and acceleration, so that nothing kinks where a foot is let go or taken up; a place other
/// than the feet's own over the whole flight. `stepping`: as many as `poses`. `samples_per_beat`
/// paces heights and hips. Threads: workers. Real-time: no.
void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<PlannedContact>, 2>& contacts,
               double samples_per_beat,
               const std::vector<Pose>& stepping,
               std::vector<Pose>& poses);

}  // namespace raks::motion
