#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"
#include "render/mannequin/bind_pose.hpp"
#include "render/mannequin/body_field.hpp"
#include "render/mannequin/mirrored_mesh.hpp"

namespace raks::render {

/// The mannequin's 14 helpers: seven of the left side, then their mirrors.
[[nodiscard]] std::array<HelperJoint, kHelperCount> mannequin_helpers(
    const motion::Skeleton& skeleton) noexcept;

/// Palette index of a helper.
enum class Helper : std::uint8_t {
    left_shoulder_half = motion::kBoneCount,
    left_upper_arm_twist,
    left_elbow_half,
    left_lower_arm_twist,
    left_hip_half,
    left_upper_leg_twist,
    left_knee_half,
    right_shoulder_half,
    right_upper_arm_twist,
    right_elbow_half,
    right_lower_arm_twist,
    right_hip_half,
    right_upper_leg_twist,
    right_knee_half,
};

/// Palette index of the joint on the other side of the body.
[[nodiscard]] constexpr std::size_t mirrored_joint(std::size_t joint) noexcept {
    constexpr std::size_t kBones = motion::kBoneCount;
    constexpr std::size_t kOneSide = kHelperCount / 2;
    if (joint < kBones) {
        return motion::index_of(motion::mirrored(static_cast<motion::Bone>(joint)));
    }
    return joint < kBones + kOneSide ? joint + kOneSide : joint - kOneSide;
}

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
