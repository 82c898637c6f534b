// A skirt on springs.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/mannequin/body_field.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// Chains about the hips, and joints of each: the last is its tip.
inline constexpr std::size_t kSkirtChains = 16;
inline constexpr std::size_t kSkirtJoints = 4;

/// Places of one chain's joints in the T-pose, from its root down; chain 0 is before the
/// left thigh, the others follow over the left side.
[[nodiscard]] std::array<glm::vec3, kSkirtJoints> skirt_chain(std::size_t chain) noexcept;

/// Adds the skirt. `hips` carries its waist; `joints`: of the skin, kSkirtJoints a chain.
void add_skirt(const BodyField& field,
               std::uint16_t hips,
               std::span<const std::uint16_t> joints,
               PaintedMesh& mesh);

}  // namespace raks::render
