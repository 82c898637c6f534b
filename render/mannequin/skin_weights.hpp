#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/avatar/avatar.hpp"
#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/mannequin/relax.hpp"
#include "render/mannequin/surface.hpp"

namespace raks::render {

/// Shares of all 66 joints in one vertex; their sum is 1.
using JointShares = std::array<float, kPaletteSize>;

/// Who moves a point of the left half of the skin. Not by distance to bones: at each joint a plane
/// of its own slope and width passes the share on to the next bone, half way through a helper
/// joint where there is one; arms first, then legs, then the spine upside down; fingers by the
/// nearest finger.
class SkinRule {
 public:
    SkinRule(const BodyField& field, const BindFrames& frames) noexcept
        : field_(field), frames_(frames) {}

    [[nodiscard]] JointShares at(glm::vec3 p) const noexcept;

 private:
    [[nodiscard]] float passed_at(std::size_t split, glm::vec3 p) const noexcept;
    [[nodiscard]] float arm_mask(glm::vec3 p, float d_body, float d_arm) const noexcept;
    float add_arm(glm::vec3 p, float d_body, float d_arm, JointShares& shares) const noexcept;
    float add_leg(glm::vec3 p,
                  float share,
                  float nearer_than_core,
                  JointShares& shares) const noexcept;
    void add_trunk(glm::vec3 p, float rest, JointShares& shares) const noexcept;
    void add_hand(glm::vec3 p, float rest, JointShares& shares) const noexcept;

    const BodyField& field_;
    const BindFrames& frames_;
};

struct PackedWeights {
    std::array<std::uint8_t, 4> joints{};
    std::array<std::uint8_t, 4> weights{};  ///< sum 255; in falling order but for rounding
};

/// Weights of the left half: the rule, three smoothing passes over the mesh, four largest kept.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<PackedWeights> skin_weights(const BodyField& field,
                                                      const BindFrames& frames,
                                                      const MirroredMesh& mesh,
                                                      const Neighbours& neighbours);

}  // namespace raks::render
