// Cloth that hangs from the waist on springs: skirts, the tails of a coat, a scarf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/mannequin/body_field.hpp"
#include "render/mannequin/painted_mesh.hpp"
#include "render/model/mannequin_style.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// How a piece of cloth is cut. Lengths in metres, heights over the floor in the T-pose; angles in
/// radians about the body from its front over its left side.
struct ClothCut {
    /// Heights of the rows from the waist down; two at one place where the hem's colour begins.
    std::span<const float> rows;
    std::size_t first_hem_row = 0;
    /// Of each chain's joints, two at least; the last is its tip. Cloth is straight between two of
    /// them: a long skirt needs one before the knee.
    std::span<const float> joint_heights;
    /// From here down it hangs free.
    float hip_line = 0.905F;
    /// Half axes at the hip line: to the side, before and behind.
    glm::vec3 half{0.180F, 0.132F, 0.132F};
    /// By which they grow a metre downward.
    glm::vec3 flare{0.30F, 0.35F, 0.35F};
    /// Depth of the folds, a metre of fall; five waves to each side.
    float folds = 0.16F;
    /// Off the skin: at the waist, and on the hips, which bulge when a thigh turns.
    float ease = 0.006F;
    float hip_ease = 0.016F;
    /// A whole ring, or from one angle to the other.
    bool is_ring = true;
    float from = 0.0F;
    float to = 0.0F;
    std::size_t chains = 16;
    std::uint32_t columns = 40;
    /// Share by which it hangs longer at an angle than on the other side.
    float longer = 0.0F;
    float longest_at = 0.0F;
    /// Radius of the capsules that stand for the thighs, and for the shanks; 0: it ends over them.
    float thigh_radius = 0.094F;
    float shank_radius = 0.0F;
    float stiffness = 0.55F;
    Paint cloth = Paint::suit;
    Paint hem = Paint::trim;
};

/// The pieces of cloth that a mannequin wears over its skin. Static tables.
[[nodiscard]] std::span<const ClothCut> cloth_of(MannequinStyle style) noexcept;

/// Places of one chain's joints in the T-pose, from its root down.
[[nodiscard]] std::vector<glm::vec3> cloth_chain(const ClothCut& cut, std::size_t chain);

/// Adds the cloth. `hips` carries its waist; `joints`: of the skin, chain after chain.
void add_cloth(const ClothCut& cut,
               const BodyField& field,
               std::uint16_t hips,
               std::span<const std::uint16_t> joints,
               PaintedMesh& mesh);

}  // namespace raks::render
