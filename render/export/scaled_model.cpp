#include "render/export/scaled_model.hpp"

namespace raks::render {
namespace {

void scale_meshes(Model& model, float factor) {
    for (ModelMesh& mesh : model.meshes) {
        for (ModelPrimitive& primitive : mesh.primitives) {
            for (glm::vec3& position : primitive.positions) {
                position *= factor;
            }
            for (MorphTarget& morph : primitive.morphs) {
                for (glm::vec3& position : morph.positions) {
                    position *= factor;
                }
            }
        }
    }
}

void scale_character(Character& character, float factor) {
    character.look_at.offset_from_head *= factor;
    for (SpringCollider& collider : character.colliders) {
        collider.offset *= factor;
        collider.tail *= factor;
        collider.radius *= factor;
    }
    for (SpringChain& chain : character.springs) {
        for (SpringJoint& joint : chain.joints) {
            joint.hit_radius *= factor;
        }
    }
}

}  // namespace

void scale_model(Model& model, float factor) {
    for (ModelNode& node : model.nodes) {
        node.translation *= factor;
    }
    scale_meshes(model, factor);
    for (ModelSkin& skin : model.skins) {
        for (glm::mat4& inverse_bind : skin.inverse_bind) {
            // Scaled, then taken back: the turn stays, the way becomes longer.
            inverse_bind[3] = glm::vec4(glm::vec3(inverse_bind[3]) * factor, inverse_bind[3].w);
        }
    }
    for (ModelMaterial& material : model.materials) {
        if (material.mtoon && material.mtoon->outline_mode == OutlineWidth::world) {
            material.mtoon->outline_width *= factor;
        }
    }
    for (ModelAnimation& animation : model.animations) {
        for (AnimationChannel& channel : animation.channels) {
            for (float& value : channel.values) {
                value *= channel.path == ChannelPath::translation ? factor : 1.0F;
            }
        }
    }
    scale_character(model.character, factor);
}

}  // namespace raks::render
