// From a pose of the humanoid to the joints of a model that stands and is built in its own way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/joint_tree.hpp"

namespace raks::render {

/// Which joint each bone of the humanoid moves, and how. Immutable once built.
///
/// Poses are rotations against the T-pose in the avatar's axes. With L the local and W the world
/// rotation of a joint in the model's T-pose, a bone's rotation q becomes L W^-1 q W
/// (VRMC_vrm_animation 1.0, how_to_transform_human_pose). Rotations of bones that a model lacks are
/// multiplied into the next bones towards the tips that it has. A limb that is one rigid part
/// points from its joint to where its hand or foot would be.
class HumanoidRig {
 public:
    /// `nodes`: the model's map. `t_pose`: the joints in the model's T-pose; for VRM this is the
    /// rest pose. Bones whose node is not shown count as lacking.
    [[nodiscard]] static HumanoidRig build(const JointTree& tree,
                                           const HumanoidMap& map,
                                           const JointState& t_pose);

    /// Writes the rotations of all mapped joints and the hips' place, `hips_scale` times the
    /// pose's: 1 where the pose was made for this body, else the ratio of hips heights. `world` is
    /// not computed. Threads: any. Real-time: yes.
    void apply(const motion::Pose& pose, float hips_scale, JointState& state) const noexcept;

    /// Joint of a bone; -1: the model lacks it.
    [[nodiscard]] int joint(motion::Bone bone) const noexcept {
        return joints_[motion::index_of(bone)];
    }
    /// Place of the hips in the T-pose; metres.
    [[nodiscard]] const glm::vec3& rest_hips() const noexcept { return rest_hips_; }

    /// Places of all bones in the T-pose; a bone that is lacking lies on the one that it hangs
    /// from.
    [[nodiscard]] const std::array<glm::vec3, motion::kBoneCount>& rest_places() const noexcept {
        return rest_places_;
    }

 private:
    struct Driven {
        std::size_t joint = 0;
        motion::Bone bone = motion::Bone::hips;
        glm::quat before{1.0F, 0.0F, 0.0F, 0.0F};  // L W^-1
        glm::quat after{1.0F, 0.0F, 0.0F, 0.0F};   // W
        // Bones between this one and the next mapped one above it, nearest first.
        std::array<motion::Bone, 4> lacking{};
        std::uint8_t lacking_count = 0;
        int limb = -1;  // in kLimbs: it is all of one, which points where its end would be
    };

    std::array<int, motion::kBoneCount> joints_{};
    std::vector<Driven> driven_;
    glm::mat4 hips_parent_from_world_{1.0F};
    glm::vec3 rest_hips_{0.0F};
    std::array<glm::vec3, motion::kBoneCount> rest_places_{};
};

}  // namespace raks::render
