// All that moves a model: bones, gaze, constraints, springs, expressions.
#pragma once

#include <string>
#include <vector>

#include "base/time.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/expressions.hpp"
#include "render/avatar/face.hpp"
#include "render/avatar/humanoid_rig.hpp"
#include "render/avatar/joint_tree.hpp"
#include "render/avatar/look_at.hpp"
#include "render/avatar/node_constraints.hpp"
#include "render/avatar/spring_rig.hpp"
#include "render/avatar/swing.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// The drivers of one model. Immutable once built; any number of dancers share it.
struct AvatarRig {
    JointTree tree;
    HumanoidRig humanoid;
    LookAtRig look_at;
    NodeConstraints constraints;
    SpringRig springs;
    ExpressionRig expressions;
    std::vector<std::string> warnings;  ///< what could not be built: one line each
};

struct RigOptions {
    float scale = 1.0F;  ///< size against the file's metres
    /// Local rotations of the model's T-pose by node; empty: it is the rest pose, as in all VRM.
    std::vector<glm::quat> t_pose;
};

[[nodiscard]] AvatarRig build_rig(const Model& model, const RigOptions& options = {});

/// What one dancer's picture needs, and what its springs remember. Made once, then reused.
struct RigState {
    explicit RigState(const AvatarRig& rig);

    JointState joints;
    FaceState face;
    Swing swing;
    std::vector<float> weights;  ///< by expression: what was asked for, before overrides
};

/// Bones, then node constraints, and `world`. Joints that swing stay as they are. `hips_scale`: as
/// for HumanoidRig::apply. Threads: one a state. Real-time: yes.
void pose_joints(const AvatarRig& rig,
                 const motion::Pose& pose,
                 float hips_scale,
                 RigState& state) noexcept;

/// The one way from pose and face to all joints and morphs of a picture: bones, gaze, constraints,
/// springs as they swing at the time of the last `advance`, expressions. Threads: one a state.
/// Real-time: yes.
void pose_avatar(const AvatarRig& rig,
                 const motion::Pose& pose,
                 const Face& face,
                 float hips_scale,
                 RigState& state) noexcept;

/// Lets the springs swing up to `time`. `pose_at(StreamTime)` gives the dancer's pose; it is asked
/// for times of steps alone (Swing). Threads: one a state. Real-time: yes, if `pose_at` is.
template <typename PoseAt>
void advance(const AvatarRig& rig,
             StreamTime time,
             float hips_scale,
             const PoseAt& pose_at,
             RigState& state) {
    if (rig.springs.size() == 0) {
        return;
    }
    state.swing.advance(rig.springs, rig.tree.joints, state.joints, time, [&](StreamTime at) {
        pose_joints(rig, pose_at(at), hips_scale, state);
    });
}

}  // namespace raks::render
