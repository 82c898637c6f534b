#include "render/avatar/avatar_rig.hpp"

namespace raks::render {
AvatarRig build_rig(const Model& model, const RigOptions& options) {
    AvatarRig rig;
    rig.tree = build_joint_tree(model, options.scale);
    const Character& character = model.character;
    const JointState rest = rest_state(rig.tree.joints);
    const JointState t_pose = t_pose_state(model, rig.tree, options.t_pose);
    rig.humanoid = HumanoidRig::build(rig.tree, character.humanoid, t_pose);
    rig.expressions = ExpressionRig::build(model);
    rig.look_at = LookAtRig::build(rig.tree, character, rig.expressions, t_pose);
    rig.constraints = NodeConstraints::build(rig.tree, character.constraints, rest, rig.warnings);
    rig.springs = SpringRig::build(rig.tree, character, rest, rig.warnings);
    return rig;
}

RigState::RigState(const AvatarRig& rig)
    : joints(rest_state(rig.tree.joints)),
      face(rig.expressions.make_state()),
      swing(rig.springs),
      weights(rig.expressions.size(), 0.0F) {}

void pose_joints(const AvatarRig& rig,
                 const motion::Pose& pose,
                 float hips_scale,
                 RigState& state) noexcept {
    rig.humanoid.apply(pose, hips_scale, state.joints);
    rig.constraints.apply(rig.tree.joints, state.joints);
    update_world(rig.tree.joints, state.joints);
}

void pose_avatar(const AvatarRig& rig,
                 const motion::Pose& pose,
                 const Face& face,
                 float hips_scale,
                 RigState& state) noexcept {
    rig.humanoid.apply(pose, hips_scale, state.joints);
    rig.expressions.spread(face, state.weights);
    Gaze gaze;
    if (face.gaze > 0.0F) {
        gaze = rig.look_at.gaze_to(face.gaze_target, rig.tree.joints, state.joints);
        gaze.yaw *= face.gaze;
        gaze.pitch *= face.gaze;
    }
    rig.look_at.apply(gaze, state.joints, state.weights);
    rig.expressions.apply(state.weights, state.face);
    rig.constraints.apply(rig.tree.joints, state.joints);
    state.swing.show(rig.springs, state.joints);
    update_world(rig.tree.joints, state.joints);
}

}  // namespace raks::render
