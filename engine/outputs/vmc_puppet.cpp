#include "engine/outputs/vmc_puppet.hpp"

#include <algorithm>
#include <utility>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {
namespace {

using motion::Bone;

constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};
constexpr float kOwnBody = 1.0F;  // poses are on the avatar's body already

// Unity's axes have x the other way round.
glm::vec3 in_unity(const glm::vec3& place) noexcept { return {-place.x, place.y, place.z}; }
glm::quat in_unity(const glm::quat& turn) noexcept { return {turn.w, turn.x, -turn.y, -turn.z}; }

// VRM 1.0 has other names for two bones of the thumb.
std::string unity_name(Bone bone) {
    std::string name(motion::kBoneNames[motion::index_of(bone)]);
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    const auto rename = [&name](std::string_view from, std::string_view to) {
        if (name.ends_with(from)) {
            name.replace(name.size() - from.size(), from.size(), to);
            return true;
        }
        return false;
    };
    if (!rename("ThumbProximal", "ThumbIntermediate")) {
        rename("ThumbMetacarpal", "ThumbProximal");
    }
    return name;
}

glm::vec3 on_floor(const glm::vec3& place) noexcept { return {place.x, 0.0F, place.z}; }

}  // namespace

VmcPuppet::VmcPuppet(std::shared_ptr<const render::Avatar> avatar, const VmcStyle& style)
    : avatar_(std::move(avatar)),
      style_(style),
      skeleton_(avatar_ ? avatar_->skeleton : motion::mannequin_skeleton()),
      pelvis_drop_(avatar_ ? avatar_->pelvis_drop : 0.0F) {
    if (avatar_ && avatar_->rig && avatar_->vrm != render::VrmVersion::none) {
        is_raw_ =
            avatar_->vrm == render::VrmVersion::vrm1 && style.rotations != VmcRotations::normalised;
        state_.emplace(*avatar_->rig);
        add_bones_of_rig();
    } else {
        add_bones_of_skeleton();
    }
}

void VmcPuppet::add_bones_of_skeleton() {
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        sources_.push_back({.joint = b});
        frame_.bones.push_back({unity_name(static_cast<Bone>(b)), in_unity(skeleton_.offsets[b])});
    }
}

void VmcPuppet::add_bones_of_rig() {
    const render::AvatarRig& rig = *avatar_->rig;
    const render::JointState rest = render::rest_state(rig.tree.joints);
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        const auto bone = static_cast<Bone>(b);
        add_joint(unity_name(bone), rig.humanoid.joint(bone), rest);
    }
    const std::array<int, 2> eyes = rig.look_at.eyes();
    add_joint("LeftEye", eyes[0], rest);
    add_joint("RightEye", eyes[1], rest);
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
        expressions_[i] = rig.expressions.find(render::kFaceExpressionNames[i]);
    }
}

void VmcPuppet::add_joint(std::string name, int joint, const render::JointState& rest) {
    if (joint < 0) {
        return;
    }
    const auto at = static_cast<std::size_t>(joint);
    const int above = avatar_->rig->tree.joints[at].parent;
    Source source{.joint = at};
    if (!is_raw_) {
        const glm::quat world = render::rotation_of(rest.world[at]);
        source.before = world * glm::inverse(rest.rotations[at]);
        source.after = glm::inverse(world);
        if (above >= 0) {
            source.parent = render::rotation_of(rest.world[static_cast<std::size_t>(above)]);
        }
    }
    frame_.bones.push_back({std::move(name), in_unity(source.parent * rest.translations[at])});
    sources_.push_back(source);
}

motion::Pose VmcPuppet::worn(const motion::Pose& danced, glm::vec2 place) const noexcept {
    motion::Pose pose = danced;
    pose.hips_position -= glm::vec3(place.x, 0.0F, place.y);
    pose = render::retargeted(pose, motion::mannequin_skeleton(), skeleton_, pelvis_drop_);
    const float way = style_.travel == VmcTravel::none ? 0.0F : style_.way;
    pose.hips_position.x *= way;
    pose.hips_position.z *= way;
    // As far from the others as suits its size.
    const float size =
        (skeleton_.hips_height() - pelvis_drop_) / motion::mannequin_skeleton().hips_height();
    pose.hips_position += size * glm::vec3(place.x, 0.0F, place.y);
    const glm::quat turn = glm::angleAxis(style_.yaw, kUp);
    pose.hips_position = turn * pose.hips_position;
    pose.rotation(Bone::hips) = turn * pose.rotation(Bone::hips);
    return pose;
}

const VmcFrame& VmcPuppet::frame(const motion::Pose& pose, const render::Face& face) {
    motion::Pose told = pose;
    frame_.root = glm::vec3(0.0F);
    if (style_.travel == VmcTravel::root) {
        const float scale = state_ ? avatar_->rig->tree.scale : 1.0F;
        frame_.root = in_unity(on_floor(pose.hips_position) / scale);
        told.hips_position = {0.0F, pose.hips_position.y, 0.0F};
    }
    if (state_) {
        tell_rig(told, face);
        return frame_;
    }
    frame_.bones.front().position = in_unity(told.hips_position);
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        frame_.bones[b].rotation = in_unity(told.local_rotations[b]);
    }
    frame_.expressions = face.weights;
    return frame_;
}

// Bones and gaze as render::pose_avatar has them. What swings, and what hangs on constraints, is
// the receiver's to move.
void VmcPuppet::tell_rig(const motion::Pose& pose, const render::Face& face) {
    const render::AvatarRig& rig = *avatar_->rig;
    render::RigState& state = *state_;
    rig.humanoid.apply(pose, kOwnBody, state.joints);
    rig.expressions.spread(face, state.weights);
    render::Gaze gaze = rig.look_at.gaze_to(face.gaze_target, rig.tree.joints, state.joints);
    gaze.yaw *= face.gaze;
    gaze.pitch *= face.gaze;
    rig.look_at.apply(gaze, state.joints, state.weights);
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const Source& source = sources_[i];
        frame_.bones[i].rotation =
            in_unity(source.before * state.joints.rotations[source.joint] * source.after);
    }
    const Source& hips = sources_.front();
    const bool is_root = rig.tree.joints[hips.joint].parent < 0;
    frame_.bones.front().position = in_unity(hips.parent * state.joints.translations[hips.joint] /
                                             (is_root ? rig.tree.scale : 1.0F));
    for (std::size_t i = 0; i < expressions_.size(); ++i) {
        frame_.expressions[i] =
            expressions_[i] < 0
                ? 0.0F
                : std::clamp(state.weights[static_cast<std::size_t>(expressions_[i])], 0.0F, 1.0F);
    }
}

}  // namespace raks::engine
