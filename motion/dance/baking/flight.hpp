// Flight: smooths the path of a foot between two contacts.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace raks::motion {

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
