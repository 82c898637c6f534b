#include "render/avatar/look_at.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

float mapped(const LookAtRange& range, float angle) noexcept {
    return std::clamp(angle / range.input_max, 0.0F, 1.0F) * range.output_scale;
}

void add_weight(std::span<float> weights, int expression, float weight) noexcept {
    if (expression >= 0) {
        weights[static_cast<std::size_t>(expression)] += weight;
    }
}

}  // namespace

LookAtRig::Eye LookAtRig::eye_of(const JointTree& tree, int node, const JointState& t_pose) {
    Eye eye{.joint = tree.joint_of(node)};
    if (eye.joint >= 0) {
        const auto joint = static_cast<std::size_t>(eye.joint);
        eye.after = rotation_of(t_pose.world[joint]);
        eye.before = t_pose.rotations[joint] * glm::inverse(eye.after);
    }
    return eye;
}

LookAtRig LookAtRig::build(const JointTree& tree,
                           const Character& character,
                           const ExpressionRig& expressions,
                           const JointState& t_pose) {
    LookAtRig rig;
    const HumanoidMap& map = character.humanoid;
    const int head = tree.joint_of(map.nodes[motion::index_of(motion::Bone::head)]);
    if (head < 0 || !character.has_look_at) {
        return rig;
    }
    rig.look_at_ = character.look_at;
    rig.head_ = head;
    rig.head_from_rest_ = glm::inverse(rotation_of(t_pose.world[static_cast<std::size_t>(head)]));
    rig.left_ = eye_of(tree, map.left_eye, t_pose);
    rig.right_ = eye_of(tree, map.right_eye, t_pose);
    rig.up_ = expressions.find("lookUp");
    rig.down_ = expressions.find("lookDown");
    rig.to_left_ = expressions.find("lookLeft");
    rig.to_right_ = expressions.find("lookRight");
    return rig;
}

Gaze LookAtRig::gaze_to(const glm::vec3& target,
                        std::span<const Joint> joints,
                        const JointState& state) const noexcept {
    if (head_ < 0) {
        return {};
    }
    const glm::mat4 head = compute_world(joints, state, static_cast<std::size_t>(head_));
    const glm::quat turned = rotation_of(head) * head_from_rest_;
    const glm::vec3 eyes(head * glm::vec4(look_at_.offset_from_head, 1.0F));
    const glm::vec3 towards = glm::inverse(turned) * (target - eyes);
    if (!(glm::length(towards) > 0.0F)) {
        return {};
    }
    return {.yaw = glm::degrees(std::atan2(towards.x, towards.z)),
            .pitch = glm::degrees(std::atan2(towards.y, std::hypot(towards.x, towards.z)))};
}

void LookAtRig::turn(const Eye& eye,
                     const Gaze& gaze,
                     const LookAtRange& to_left,
                     const LookAtRange& to_right,
                     JointState& state) const noexcept {
    if (eye.joint < 0) {
        return;
    }
    const float yaw = gaze.yaw > 0.0F ? mapped(to_left, gaze.yaw) : -mapped(to_right, -gaze.yaw);
    const float pitch = gaze.pitch > 0.0F ? mapped(look_at_.vertical_up, gaze.pitch)
                                          : -mapped(look_at_.vertical_down, -gaze.pitch);
    // A turn about +x lowers the gaze.
    const glm::quat rotation = glm::angleAxis(glm::radians(yaw), glm::vec3(0.0F, 1.0F, 0.0F)) *
                               glm::angleAxis(glm::radians(-pitch), glm::vec3(1.0F, 0.0F, 0.0F));
    state.rotations[static_cast<std::size_t>(eye.joint)] =
        glm::normalize(eye.before * rotation * eye.after);
}

void LookAtRig::apply(const Gaze& gaze,
                      JointState& state,
                      std::span<float> weights) const noexcept {
    if (head_ < 0) {
        return;
    }
    if (look_at_.is_by_bones) {
        turn(left_, gaze, look_at_.horizontal_outer, look_at_.horizontal_inner, state);
        turn(right_, gaze, look_at_.horizontal_inner, look_at_.horizontal_outer, state);
        return;
    }
    // Expressions move both eyes by the same: the outer range is theirs.
    const LookAtRange& sideways = look_at_.horizontal_outer;
    add_weight(weights, to_left_, mapped(sideways, gaze.yaw));
    add_weight(weights, to_right_, mapped(sideways, -gaze.yaw));
    add_weight(weights, up_, mapped(look_at_.vertical_up, gaze.pitch));
    add_weight(weights, down_, mapped(look_at_.vertical_down, -gaze.pitch));
}

}  // namespace raks::render
