// Where the eyes look: by their bones or by expressions.
#pragma once

#include <array>
#include <span>

#include "render/avatar/expressions.hpp"
#include "render/avatar/face.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/model/character.hpp"

namespace raks::render {

/// A direction of the gaze against the head at rest.
struct Gaze {
    float yaw = 0.0F;    ///< degrees; above 0: to the figure's left
    float pitch = 0.0F;  ///< degrees; above 0: up
};

/// Moves the eyes of one model (VRMC_vrm 1.0, lookAt.md). Immutable once built.
class LookAtRig {
 public:
    LookAtRig() = default;
    /// `t_pose`: the joints in the model's T-pose. A model without head or look-at does not look.
    [[nodiscard]] static LookAtRig build(const JointTree& tree,
                                         const Character& character,
                                         const ExpressionRig& expressions,
                                         const JointState& t_pose);

    /// Whether the eyes can move at all.
    [[nodiscard]] bool can_look() const noexcept { return head_ >= 0; }
    /// The joints of the left and the right eye; -1: there is none, or it does not move.
    [[nodiscard]] std::array<int, 2> eyes() const noexcept { return {left_.joint, right_.joint}; }

    /// The gaze from the head as it is posed now to a point of the world; straight ahead where it
    /// cannot look. Reads rotations and translations, not `world`. Threads: any. Real-time: yes.
    [[nodiscard]] Gaze gaze_to(const glm::vec3& target,
                               std::span<const Joint> joints,
                               const JointState& state) const noexcept;

    /// Turns the eyes' joints, or adds to the weights of lookUp, lookDown, lookLeft and lookRight.
    /// `world` is not computed. Threads: any. Real-time: yes.
    void apply(const Gaze& gaze, JointState& state, std::span<float> weights) const noexcept;

 private:
    struct Eye {
        int joint = -1;
        glm::quat before{1.0F, 0.0F, 0.0F, 0.0F};  // as HumanoidRig: L W^-1 ...
        glm::quat after{1.0F, 0.0F, 0.0F, 0.0F};   // ... and W
    };

    static Eye eye_of(const JointTree& tree, int node, const JointState& t_pose);
    void turn(const Eye& eye,
              const Gaze& gaze,
              const LookAtRange& to_left,
              const LookAtRange& to_right,
              JointState& state) const noexcept;

    LookAt look_at_;
    int head_ = -1;
    glm::quat head_from_rest_{1.0F, 0.0F, 0.0F, 0.0F};  // inverse of the head's rotation at rest
    Eye left_;
    Eye right_;
    int up_ = -1;  // expressions
    int down_ = -1;
    int to_left_ = -1;
    int to_right_ = -1;
};

}  // namespace raks::render
