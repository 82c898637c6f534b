#include "render/avatar/model_avatar.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "render/avatar/surface_builder.hpp"

#include <glm/vec4.hpp>

namespace raks::render {
namespace {

using motion::Bone;

/// Joints of feet and toes, and all that hangs from them.
std::vector<bool> foot_joints(const AvatarRig& rig) {
    std::vector<bool> is_foot(rig.tree.joints.size(), false);
    for (const Bone bone : {Bone::left_foot, Bone::right_foot, Bone::left_toes, Bone::right_toes}) {
        if (rig.humanoid.joint(bone) >= 0) {
            is_foot[static_cast<std::size_t>(rig.humanoid.joint(bone))] = true;
        }
    }
    for (std::size_t i = 0; i < is_foot.size(); ++i) {
        const int parent = rig.tree.joints[i].parent;
        if (parent >= 0 && is_foot[static_cast<std::size_t>(parent)]) {
            is_foot[i] = true;
        }
    }
    return is_foot;
}

/// Where a vertex is in a state of the joints.
glm::vec3 place_of(const SurfaceVertex& vertex,
                   const SurfaceSkin& skin,
                   const JointState& state) noexcept {
    const glm::vec4 at(vertex.position[0], vertex.position[1], vertex.position[2], 1.0F);
    glm::vec4 sum(0.0F);
    for (std::size_t k = 0; k < vertex.joints.size(); ++k) {
        const float weight = static_cast<float>(vertex.weights[k]) / 65'535.0F;
        if (weight > 0.0F) {
            const std::size_t joint = vertex.joints[k];
            sum += weight * (state.world[static_cast<std::size_t>(skin.joints[joint])] *
                             (skin.inverse_bind[joint] * at));
        }
    }
    return glm::vec3(sum);
}

/// Height of the soles in the T-pose: the lowest of what the feet move; 0 where that is nothing.
float sole_height(const Surface& surface, const AvatarRig& rig, const JointState& t_pose) {
    const std::vector<bool> is_foot = foot_joints(rig);
    float lowest = std::numeric_limits<float>::max();
    for (const SurfacePart& part : surface.parts) {
        const SurfaceSkin& skin = surface.skins[static_cast<std::size_t>(part.skin)];
        for (std::uint32_t i = 0; i < part.index_count; ++i) {
            const SurfaceVertex& vertex = surface.vertices[surface.indices[part.first_index + i]];
            const std::size_t joint = vertex.joints[0];
            if (is_foot[static_cast<std::size_t>(skin.joints[joint])]) {
                lowest = std::min(lowest, place_of(vertex, skin, t_pose).y);
            }
        }
    }
    return lowest == std::numeric_limits<float>::max() ? 0.0F : lowest;
}

/// The body that dances are made for: places of the bones in the T-pose, standing on the floor.
motion::Skeleton skeleton_of(const AvatarRig& rig, float soles) {
    const auto& places = rig.humanoid.rest_places();
    motion::Skeleton skeleton = motion::mannequin_skeleton();
    if (rig.humanoid.joint(Bone::hips) < 0) {
        return skeleton;  // a thing, no figure
    }
    const float size = (places[0].y - soles) / std::max(skeleton.hips_height(), 1e-3F);
    skeleton = motion::scaled(skeleton, size);
    for (std::size_t i = 0; i < places.size(); ++i) {
        skeleton.offsets[i] = i == 0 ? glm::vec3(0.0F, places[i].y - soles, 0.0F)
                                     : places[i] - places[motion::kBoneParents[i]];
    }
    // The sole under the ankle as it is; its length after the mannequin's.
    const float ankle = places[motion::index_of(Bone::left_foot)].y - soles;
    skeleton.ball.y = skeleton.heel.y = -ankle;
    return skeleton;
}

/// Rims without a colour of their own are drawn where an expression gives them one.
void note_face_rims(const Model& model, Surface& surface) {
    for (const Expression& expression : model.character.expressions) {
        for (const ColourBind& bind : expression.colours) {
            if (bind.kind == ColourBindKind::rim && bind.material >= 0) {
                auto& toon = surface.materials[static_cast<std::size_t>(bind.material)].mtoon;
                if (toon) {
                    toon->has_face_rim = true;
                }
            }
        }
    }
}

}  // namespace

Avatar build_avatar(const Model& model, std::vector<Image> images, const RigOptions& options) {
    Avatar avatar;
    avatar.name =
        model.character.licence.title.empty() ? model.name : model.character.licence.title;
    avatar.licence = model.character.licence.name;
    auto rig = std::make_shared<AvatarRig>(build_rig(model, options));
    avatar.surface = build_surface(model, *rig, std::move(images));
    note_face_rims(model, avatar.surface);
    RigState t_pose(*rig);
    motion::Pose standing;
    standing.hips_position = rig->humanoid.rest_hips();
    pose_joints(*rig, standing, 1.0F, t_pose);
    avatar.soles = sole_height(avatar.surface, *rig, t_pose.joints);
    avatar.skeleton = skeleton_of(*rig, avatar.soles);
    avatar.rig = std::move(rig);
    return avatar;
}

}  // namespace raks::render
