// Hair: a shell about the skull, locks, and a tail on springs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/mannequin/body_field.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

enum class HairStyle : std::uint8_t {
    ponytail,  ///< drawn back, with locks beside the face and a tail that swings
    cropped,   ///< short at the sides, swept up over the forehead
};

/// Places of a tail's joints in the T-pose, from where it is tied to its tip; empty: no tail.
[[nodiscard]] std::span<const glm::vec3> hair_tail(HairStyle style) noexcept;

/// Adds the hair. `head`: joint of the skin that carries it; `tail`: its joints, as many as
/// hair_tail has places. Mirror-symmetric.
void add_hair(const BodyField& field,
              HairStyle style,
              std::uint16_t head,
              std::span<const std::uint16_t> tail,
              PaintedMesh& mesh);

}  // namespace raks::render
