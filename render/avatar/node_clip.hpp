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
    /// Rotation of what each bone hangs on in its rig, and the parent of each node there
    /// (StandingBody::parents); for a NodeClip that moves others.
    std::array<glm::quat, motion::kBoneCount> above{};
    std::vector<int> parents;
    /// The turn about y from the file's world into that one.
    glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};
};

/// What becomes of all that a pose does not hold: nodes that are no bones, and where bones are and
/// how large.
enum class OtherNodes {
    folded,  ///< a node that lies between two bones turns the lower one; the rest is left out
    moved,   ///< move_others moves it
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

    /// With OtherNodes::moved: puts all joints but those above the hips where the clip has them,
    /// as large as there, so that with the pose of the same time, which turns the bones anew, the
    /// model is as the clip has it; else nothing. `hips`: where that pose has the hips on the rig.
    /// `tree`: of the rig of this model, at any size. `world` is not computed.
    void move_others(float seconds,
                     const glm::vec3& hips,
                     const JointTree& tree,
                     JointState& state);

 private:
    void move_nodes(float seconds);
    [[nodiscard]] glm::quat turn_in_rig(std::size_t bone) const;

    const Model& model_;
    BoneRest rest_;
    OtherNodes others_;
    std::vector<std::size_t> order_;   // nodes, parents first
    std::vector<NodeChannels> moved_;  // by node
    std::vector<bool> carries_hips_;   // nodes above the hips in the rig, which the pose moves
    std::vector<glm::mat4> world_;     // by node, as of the last time that was asked for
    float duration_ = 0.0F;
};

}  // namespace raks::render
