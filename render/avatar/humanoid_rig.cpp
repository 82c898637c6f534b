#include "render/avatar/humanoid_rig.hpp"

#include "render/avatar/limb_parts.hpp"

#include <glm/matrix.hpp>

namespace raks::render {
namespace {

using motion::Bone;
using motion::index_of;

Bone parent_of(Bone bone) noexcept {
    return static_cast<Bone>(motion::kBoneParents[index_of(bone)]);
}

}  // namespace

HumanoidRig HumanoidRig::build(const JointTree& tree,
                               const HumanoidMap& map,
                               const JointState& t_pose) {
    HumanoidRig rig;
    std::array<bool, motion::kBoneCount> is_there{};
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        rig.joints_[b] = tree.joint_of(map.nodes[b]);
        is_there[b] = rig.joints_[b] >= 0;
    }
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        const auto bone = static_cast<Bone>(b);
        if (rig.joints_[b] < 0) {
            rig.rest_places_[b] = rig.rest_places_[index_of(parent_of(bone))];
            continue;
        }
        const auto joint = static_cast<std::size_t>(rig.joints_[b]);
        const glm::quat world = rotation_of(t_pose.world[joint]);
        Driven driven{.joint = joint,
                      .bone = bone,
                      .before = t_pose.rotations[joint] * glm::inverse(world),
                      .after = world};
        for (Bone up = bone; up != Bone::hips;) {
            up = parent_of(up);
            if (rig.joint(up) >= 0 || driven.lacking_count == driven.lacking.size()) {
                break;
            }
            driven.lacking[driven.lacking_count++] = up;
        }
        for (std::size_t limb = 0; limb < kLimbs.size(); ++limb) {
            if (kLimbs[limb].upper == bone && is_one_part(kLimbs[limb], is_there)) {
                driven.limb = static_cast<int>(limb);
            }
        }
        rig.rest_places_[b] = glm::vec3(t_pose.world[joint][3]);
        rig.driven_.push_back(driven);
    }
    rig.rest_hips_ = rig.rest_places_[0];
    const int hips = rig.joint(Bone::hips);
    const int above = hips < 0 ? -1 : tree.joints[static_cast<std::size_t>(hips)].parent;
    if (above >= 0) {
        rig.hips_parent_from_world_ = glm::inverse(t_pose.world[static_cast<std::size_t>(above)]);
    }
    return rig;
}

void HumanoidRig::apply(const motion::Pose& pose,
                        float hips_scale,
                        JointState& state) const noexcept {
    for (const Driven& driven : driven_) {
        glm::quat rotation = pose.rotation(driven.bone);
        for (std::size_t i = 0; i < driven.lacking_count; ++i) {
            rotation = pose.rotation(driven.lacking[i]) * rotation;
        }
        if (driven.limb >= 0) {
            rotation =
                rotation * swing_of_part(kLimbs[static_cast<std::size_t>(driven.limb)], pose);
        }
        state.rotations[driven.joint] = glm::normalize(driven.before * rotation * driven.after);
    }
    if (joint(Bone::hips) >= 0) {
        const glm::vec4 place(pose.hips_position * hips_scale, 1.0F);
        state.translations[static_cast<std::size_t>(joint(Bone::hips))] =
            glm::vec3(hips_parent_from_world_ * place);
    }
}

}  // namespace raks::render
