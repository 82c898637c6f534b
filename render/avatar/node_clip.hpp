// A model's own clips as poses: of any glTF whose figure is known, however it stands.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/model/animation_channel.hpp"
#include "render/model/model.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

namespace raks::render {

/// How the bones of a model stand in its T-pose, in the world in which the figure faces +z.
struct BoneRest {
    std::array<glm::quat, motion::kBoneCount> world{};  ///< rotation of each bone's node
    /// Rotation of the node above each bone's; for a NodeClip that moves others.
    std::array<glm::quat, motion::kBoneCount> above{};
    /// The turn about y from the file's world into that one.
    glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
};

/// What becomes of nodes that are no bones.
enum class OtherNodes {
    folded,  ///< one that lies between two bones turns the lower one
    moved,   ///< move_others moves all but those above the hips
};

/// Samples one clip of a model whose humanoid is mapped: all nodes are moved as glTF says, and a
/// bone's pose is its turn in the world since the T-pose against that of the next bone above it. So
/// nodes between two bones may turn, and feet may hang on the root (inverse kinematics).
/// The model must outlive it. Threads: one. Real-time: no.
class NodeClip {
 public:
    /// `animation`: index in Model::animations.
    NodeClip(const Model& model,
             std::size_t animation,
             const BoneRest& rest,
             OtherNodes others = OtherNodes::folded);

    /// Seconds to the last key; 0: a single posture.
    [[nodiscard]] float duration() const noexcept { return duration_; }

    /// The pose at `seconds`, held before the first key and after the last one. The hips are where
    /// they are in the file's metres.
    [[nodiscard]] motion::Pose pose_at(float seconds);

    /// With OtherNodes::moved: moves the joints of nodes that are no bones, such as helpers, hair
    /// and faces, against their parents; else nothing. `tree`: of this model, at any size. `world`
    /// is not computed. Threads: any. Real-time: yes.
    void move_others(float seconds, const JointTree& tree, JointState& state) const noexcept;

 private:
    void move_nodes(float seconds);
    void find_others();
    [[nodiscard]] glm::quat turn_below_parent(std::size_t bone, float seconds) const;
    void take_between(motion::Bone bone);

    const Model& model_;
    BoneRest rest_;
    std::vector<std::size_t> order_;   // nodes, parents first
    std::vector<NodeChannels> moved_;  // by node
    std::vector<int> others_;          // nodes that move_others moves
    // Whether such a node lies between the bone and the next above it, which the bone's own turn
    // does not hold then.
    std::array<bool, motion::kBoneCount> is_apart_{};
    std::vector<glm::mat4> world_;  // by node, as of the last pose
    float duration_ = 0.0F;
};

}  // namespace raks::render
