#pragma once

#include <vector>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Brings hands and forearms that are in trunk, thighs or head out of them, by the arm alone:
/// repeats vary arms and body each by itself, and arms that hang would pass through the hips.
/// Softly, from 3.5 cm before they touch: what moves smoothly still does. Threads: any. Real-time:
/// yes.
void clear_hands(const Skeleton& skeleton, Pose& pose) noexcept;

/// The same for poses in a row, with all of them in view: a hand that would cut
/// through the body is led round it, with 2 cm to spare, over a third of a beat before and after.
/// Pose by pose it is thrown out and back (up to 18,000 m/s^3). Threads: workers. Real-time: no.
void lead_hands_round(const Skeleton& skeleton, double samples_per_beat, std::vector<Pose>& poses);

}  // namespace raks::motion
