#include "apps/xbody/model_look.hpp"

#include <algorithm>
#include <cstddef>

#include <glm/common.hpp>

namespace raks::apps {
namespace {

using render::Model;
using render::ModelPrimitive;

std::size_t slot_of(int index) { return static_cast<std::size_t>(index); }

/// Paints the meshes of a model.
class Painter {
 public:
    Painter(Model& model, const ModelLook& look) : model_(model), look_(look) {}

    // Nodes that share a mesh may have other skins: each gets a mesh of its own.
    void paint() {
        render::ModelMaterial plain;
        plain.name = "paint";
        plain.is_unlit = true;
        plain.is_double_sided = true;
        model_.materials.push_back(plain);
        std::vector<render::ModelMesh> meshes;
        for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
            render::ModelNode& node = model_.nodes[i];
            if (node.mesh < 0) {
                continue;
            }
            meshes.push_back(model_.meshes[slot_of(node.mesh)]);
            node.mesh = static_cast<int>(meshes.size()) - 1;
            for (ModelPrimitive& primitive : meshes.back().primitives) {
                paint(static_cast<int>(i), primitive);
            }
        }
        model_.meshes = std::move(meshes);
    }

 private:
    void paint(int node, ModelPrimitive& primitive) const {
        primitive.material = static_cast<int>(model_.materials.size()) - 1;
        primitive.colours.assign(primitive.positions.size(), glm::vec4(1.0F));
        if (look_.paint == ModelPaint::dark) {
            constexpr glm::vec4 kDark(0.02F, 0.05F, 0.12F, 1.0F);
            primitive.colours.assign(primitive.positions.size(), kDark);
            return;
        }
        if (look_.paint == ModelPaint::normals) {
            for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
                primitive.colours[i] = glm::vec4(0.5F + 0.5F * primitive.normals[i], 1.0F);
            }
            return;
        }
        const int skin = primitive.joints.empty() ? -1 : model_.nodes[slot_of(node)].skin;
        for (std::size_t i = 0; i < primitive.colours.size(); ++i) {
            const float weight = skin >= 0             ? weight_of(skin, primitive, i)
                                 : node == look_.joint ? 1.0F
                                                       : 0.0F;
            primitive.colours[i] = glm::vec4(colour_of_weight(weight), 1.0F);
        }
    }

    [[nodiscard]] float weight_of(int skin,
                                  const ModelPrimitive& primitive,
                                  std::size_t vertex) const {
        const std::vector<int>& joints = model_.skins[slot_of(skin)].joints;
        float weight = 0.0F;
        for (std::size_t i = 0; i < 4; ++i) {
            if (joints[primitive.joints[vertex][i]] == look_.joint) {
                weight += primitive.weights[vertex][i];
            }
        }
        return weight;
    }

    Model& model_;
    const ModelLook& look_;
};

}  // namespace

glm::vec3 colour_of_weight(float weight) noexcept {
    constexpr glm::vec3 kNone(0.05F, 0.08F, 0.35F);
    constexpr glm::vec3 kHalf(0.1F, 0.7F, 0.12F);
    constexpr glm::vec3 kAll(0.9F, 0.06F, 0.03F);
    const float at = std::clamp(weight, 0.0F, 1.0F);
    return at < 0.5F ? glm::mix(kNone, kHalf, 2.0F * at) : glm::mix(kHalf, kAll, 2.0F * at - 1.0F);
}

Model looked(const Model& model, const ModelLook& look) {
    Model shown = model;
    shown.images.clear();
    for (std::size_t i = 0; i < look.is_hidden.size(); ++i) {
        if (look.is_hidden[i]) {
            shown.nodes[i].mesh = -1;
            shown.nodes[i].skin = -1;
        }
    }
    if (look.paint != ModelPaint::own) {
        Painter(shown, look).paint();
    }
    return shown;
}

}  // namespace raks::apps
