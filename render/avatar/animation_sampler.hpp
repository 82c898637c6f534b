// Clips of a model file (VRMA, or a glTF's own) as poses and faces.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "motion/skeleton/pose.hpp"
#include "render/avatar/face.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/model/animation_channel.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Samples one clip of a model whose humanoid is mapped. With L the local and W the world rotation
/// of a node at rest, a node's rotation r is the pose's W L^-1 r W^-1
/// (VRMC_vrm_animation 1.0, how_to_transform_human_pose). In VRMA the rotation counts from the next
/// bone above, as three-vrm has it: nodes between two bones are taken not to turn. The model must
/// outlive it.
class AnimationSampler {
 public:
    /// `animation`: index in Model::animations. `t_pose`: local rotations of the T-pose by node;
    /// empty: it is the rest pose, as in VRMA.
    AnimationSampler(const Model& model,
                     std::size_t animation,
                     const std::vector<glm::quat>& t_pose = {});

    /// Seconds to the last key; 0: a single posture.
    [[nodiscard]] float duration() const noexcept { return duration_; }
    /// Whether the hips travel; else they stay at their rest place.
    [[nodiscard]] bool has_travel() const noexcept { return has_travel_; }
    /// Whether it moves expressions or the gaze.
    [[nodiscard]] bool has_face() const noexcept {
        return !expressions_.empty() || gaze_ != nullptr;
    }
    /// Place of the hips at rest; metres. The ratio of hips heights scales their travel.
    [[nodiscard]] const glm::vec3& rest_hips() const noexcept { return rest_hips_; }

    /// The pose at `seconds`, held before the first key and after the last one. Threads: any.
    /// Real-time: yes.
    [[nodiscard]] motion::Pose pose_at(float seconds) const noexcept;

    /// Weights of the expressions that the clip moves, and its gaze. Threads: any. Real-time: yes.
    [[nodiscard]] Face face_at(float seconds) const noexcept;

 private:
    struct Turned {
        const AnimationChannel* channel = nullptr;
        motion::Bone bone = motion::Bone::hips;
        glm::quat before{1.0F, 0.0F, 0.0F, 0.0F};  // W L^-1, or W of the bone above
        glm::quat after{1.0F, 0.0F, 0.0F, 0.0F};   // W^-1
    };

    void add_bone(const Model& model,
                  const JointTree& tree,
                  const JointState& rest,
                  motion::Bone bone,
                  const AnimationChannel& channel);
    void add_face(const Model& model, const AnimationChannel& channel);

    std::vector<Turned> turned_;
    const AnimationChannel* hips_ = nullptr;
    glm::mat4 world_from_hips_parent_{1.0F};
    glm::vec3 rest_hips_{0.0F};
    bool has_travel_ = false;
    float duration_ = 0.0F;
    std::vector<std::pair<FaceExpression, const AnimationChannel*>> expressions_;
    const AnimationChannel* gaze_ = nullptr;
};

}  // namespace raks::render
