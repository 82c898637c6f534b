// Hands: fingers relaxed, hands and forearms kept out of the body.
#pragma once

#include <vector>

#include "base/realtime.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Bends the fingers softly, more toward the little finger, as a dancer's: captured clips leave
/// them straight. Threads: any. Real-time: yes.
void relax_hands(Pose& pose) noexcept RAKS_NONBLOCKING;

/// Moves hands and forearms that are inside trunk, thighs or head out of them, by the arm alone:
/// passages vary arms and body independently, so hanging arms may pass through the hips. It begins
/// softly, 3.5 cm before they touch, so that smooth motion stays smooth. Threads: any. Real-time:
/// yes.
void clear_hands(const Skeleton& skeleton, Pose& pose) noexcept RAKS_NONBLOCKING;

/// The same for a row of poses, with all of them known: a hand that would cut through the body is
/// led round it, aiming 4 cm off the skin, and smoothly: the pushes are filtered over 0.15 beats
/// (deviation). Pose by pose it would be thrown out and back (up to 18,000 m/s^3). Threads:
/// workers. Real-time: no.
void lead_hands_round(const Skeleton& skeleton, double samples_per_beat, std::vector<Pose>& poses);

}  // namespace raks::motion
