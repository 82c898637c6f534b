#pragma once

#include <vector>

#include "motion/dance/baking/foot_lock.hpp"
#include "motion/dance/body/leg_ik.hpp"

namespace raks::motion {

/// The same steps along the same paths, in time with the contacts. A foot that comes to rest by
/// itself before its contact begins (PlannedContact::arrival) is danced slower from where it left
/// the floor on, and the contact's rest makes up for it. And a mean over repeats that step at
/// different moments halts on its way or hardly moves, which is seen as a landing, or as none: such
/// a foot goes, in part, at the speed of one reach (Flash, Hogan 1985, "The coordination of arm
/// movements"). Steps that are no means (PlannedContact::is_mean) keep their time.
///
/// `feet`: a closed curve, a place a sample. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<FootTarget> in_time(const std::vector<PlannedContact>& contacts,
                                              const std::vector<FootTarget>& feet);

/// The same steps along the same paths, once it is known where they come down: the speed of each
/// rises once and falls once. What is left of a mean's halts, and going over from where a step was
/// learnt to where it is planted, slows a foot on its way; in a slow dance that is seen as its
/// landing. Steps that are no means keep their time. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<FootTarget> rising_once(const std::vector<PlannedContact>& contacts,
                                                  const std::vector<FootTarget>& feet);

}  // namespace raks::motion
