// Flight: the time and the path of a foot between two contacts.
#pragma once

#include <vector>

#include "motion/dance/baking/foot_lock.hpp"
#include "motion/dance/body/limb_ik.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// Retimes the steps to their contacts; the paths stay. Two corrections: (1) A foot that comes to
/// rest before its contact begins (PlannedContact::arrival) is slowed from where it left the floor,
/// and catches up during the contact. (2) A mean over repeats that step at different moments halts
/// on its way, or hardly moves, which landing detection takes for a landing or misses. Such a
/// flight is blended with the speed profile of one reach (Flash, Hogan 1985, "The coordination of
/// arm movements"). Steps that are no means (PlannedContact::is_mean) skip (2).
///
/// `feet`: a closed curve, one target a sample. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<FootTarget> in_time(const std::vector<PlannedContact>& contacts,
                                              const std::vector<FootTarget>& feet);

/// Gives the speed of each step a single peak, once the feet are planted; the paths stay. What
/// remains of a mean's halts, and the shift from the learnt place to the planted one, slow a foot
/// on its way; at a slow tempo landing detection takes that for the landing. Steps that are no
/// means keep their time. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<FootTarget> rising_once(const std::vector<PlannedContact>& contacts,
                                                  const std::vector<FootTarget>& feet);

/// Smooths the path of a foot between its rests: the result has the least squared jerk while it
/// stays near the given path, and joins each rest with that rest's own speed and acceleration. This
/// is a smoothing spline of the fifth degree (Reinsch 1967; least jerk: Flash, Hogan 1985, "The
/// coordination of arm movements"), a low-pass at `bandwidth` without delay.
///
/// `rests`: by sample of `path`, a closed curve; samples where it is true stay. `bandwidth`: cycles
/// a sample, where half of the amplitude remains. A path that never rests stays. Threads: workers.
/// Real-time: no.
void fly(const std::vector<bool>& rests, double bandwidth, std::vector<glm::vec3>& path);

}  // namespace raks::motion
