// Occlusion: which markers a camera sees past the body that carries them.
#pragma once

#include <vector>

#include "motion/skeleton/body_capsules.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::capture {

/// The capsules of a pose that hide what is behind them: those of motion/skeleton/body_capsules.hpp
/// and of both arms.
[[nodiscard]] std::vector<motion::Capsule> hiding_capsules(const motion::Skeleton& skeleton,
                                                           const motion::WorldPose& world);

/// Whether a capsule hides `place` from a camera at `centre`. A capsule in which the place itself
/// lies, as a marker's does on a fat limb, is taken to reach just up to it.
[[nodiscard]] bool is_hidden(const std::vector<motion::Capsule>& capsules,
                             const glm::vec3& place,
                             const glm::vec3& centre);

}  // namespace raks::capture
