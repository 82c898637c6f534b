#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/dance/contact_windows.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Plants the feet of a closed figure: the hips' height is set so that the standing foot is on the
/// floor, the ball of a foot in contact stays where it is on average (the foot may turn about it),
/// toes bend by the ball when the heel rises, no part of a sole goes below the floor, and the hips
/// sink where a leg would not reach. Sets foot_contact. (Kovar, Schreiner, Gleicher 2002,
/// "Footskate cleanup for motion capture editing".)
///
/// What the lock moves an ankle by is carried over each flight by a quintic that meets both
/// contacts with their speed and acceleration: nothing kinks where a foot is let go or taken up.
/// `samples_per_beat` paces heights and hips. Threads: workers. Real-time: no.
void lock_feet(const Skeleton& skeleton,
               const std::array<std::vector<ContactWindow>, 2>& contacts,
               double samples_per_beat,
               std::vector<Pose>& poses);

}  // namespace raks::motion
