#include "render/avatar/model_avatar.hpp"

#include <cstddef>
#include <memory>
#include <utility>

#include "render/avatar/body_measure.hpp"
#include "render/avatar/limb_parts.hpp"
#include "render/avatar/surface_builder.hpp"

namespace raks::render {
namespace {

/// What the rig's T-pose says of the bones.
BonePlaces bones_of(const HumanoidRig& humanoid) {
    BonePlaces bones{.places = humanoid.rest_places(), .is_there = {}};
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        bones.is_there[b] = humanoid.joint(static_cast<motion::Bone>(b)) >= 0;
    }
    return bones;
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
    return build_avatar_with(std::make_shared<SurfaceImages>(std::move(images)), model, options);
}

Avatar build_avatar_with(std::shared_ptr<SurfaceImages> images,
                         const Model& model,
                         const RigOptions& options) {
    Avatar avatar;
    avatar.name =
        model.character.licence.title.empty() ? model.name : model.character.licence.title;
    avatar.licence = model.character.licence.name;
    auto rig = std::make_shared<AvatarRig>(build_rig(model, options));
    avatar.surface = build_surface(model, *rig, std::move(images));
    note_face_rims(model, avatar.surface);
    avatar.skeleton = motion::mannequin_skeleton();
    avatar.rig = rig;
    avatar.vrm = model.character.vrm;
    // Without hips it is a thing, no figure.
    if (rig->humanoid.joint(motion::Bone::hips) >= 0) {
        std::vector<FleshPoint> flesh = flesh_of(avatar);
        BonePlaces bones = bones_of(rig->humanoid);
        if (model.character.humanoid.is_of_parts) {
            add_lacking_joints(flesh, bones);
        }
        const MeasuredBody body = measure_body(flesh, bones);
        avatar.skeleton = body.skeleton;
        avatar.soles = body.soles;
        avatar.height = body.height;
        avatar.pelvis_drop = body.pelvis_drop;
    }
    return avatar;
}

}  // namespace raks::render
