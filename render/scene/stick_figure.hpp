#pragma once

#include <array>
#include <cstdint>

#include "motion/skeleton/skeleton.hpp"
#include "render/scene/stage_shapes.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// A point of the stick figure, fixed to one bone.
struct StickVertex {
    glm::vec3 position{};        ///< in the bone's frame, metres
    glm::vec3 normal{};          ///< unit, same frame
    std::uint8_t bone = 0;       ///< motion::Bone
    std::uint8_t left = 0;       ///< share of the left side's colour, 0..255
    std::uint8_t right = 0;      ///< and of the right's; the rest is the middle's
    std::uint8_t occlusion = 0;  ///< 255: open to the light
};

/// The stick figure of a skeleton: spheres at the joints, round cones for bones, an egg for a head
/// with a nose that shows where it faces. Left, right and middle differ in colour. Pure.
[[nodiscard]] Shape<StickVertex> stick_figure(const motion::Skeleton& skeleton);

}  // namespace raks::render
