#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace raks::motion {

/// A foot between its rests: where it flies the path becomes the smoothest (least squared jerk)
/// that stays near itself, and it leaves and meets each rest with the rest's own speed and
/// acceleration. A smoothing spline of the fifth degree (Reinsch 1967; least jerk: Flash, Hogan
/// 1985, "The coordination of arm movements"): what is faster than `bandwidth` is taken off,
/// without delay.
///
/// `rests`: by sample of `path`, a closed curve; where true the path stays. `bandwidth`: cycles a
/// sample, at which half remains. A path that never rests stays. Threads: workers. Real-time: no.
void fly(const std::vector<bool>& rests, double bandwidth, std::vector<glm::vec3>& path);

}  // namespace raks::motion
