#include "render/model/sub_meshes.hpp"

#include <algorithm>
#include <set>

namespace raks::render {
namespace {

std::vector<std::pair<int, int>> texture_sizes(const Model& model, int material) {
    std::vector<std::pair<int, int>> sizes;
    if (material < 0) {
        return sizes;
    }
    std::set<int> seen;
    for (const TextureUse& use : textures_of(model.materials[static_cast<std::size_t>(material)])) {
        const int image =
            use.texture < 0 ? -1 : model.textures[static_cast<std::size_t>(use.texture)].image;
        if (image >= 0 && seen.insert(image).second) {
            const ModelImage& packed = model.images[static_cast<std::size_t>(image)];
            sizes.emplace_back(packed.width, packed.height);
        }
    }
    return sizes;
}

void count_weights(const ModelPrimitive& primitive, SubMesh& part) {
    std::set<int> joints;
    for (std::size_t vertex = 0; vertex < primitive.weights.size(); ++vertex) {
        for (std::size_t i = 0; i < 4; ++i) {
            const float weight = primitive.weights[vertex][i];
            if (weight > 0.0F) {
                joints.insert(primitive.joints[vertex][i]);
            }
        }
    }
    part.joints = joints.size();
    part.uneven_weights = primitive.uneven_weights;
}

}  // namespace

std::vector<TextureUse> textures_of(const ModelMaterial& material) {
    std::vector<TextureUse> uses = {material.base_texture,
                                    material.metallic_roughness_texture,
                                    material.normal_texture,
                                    material.occlusion_texture,
                                    material.emissive_texture};
    if (const auto& mtoon = material.mtoon) {
        uses.insert(uses.end(),
                    {mtoon->shade_texture,
                     mtoon->shading_shift_texture,
                     mtoon->matcap_texture,
                     mtoon->rim_texture,
                     mtoon->outline_width_texture,
                     mtoon->uv_mask_texture});
    }
    return uses;
}

std::vector<bool> used_images(const Model& model) {
    std::vector<bool> is_used(model.images.size(), false);
    for (const ModelMaterial& material : model.materials) {
        for (const TextureUse& use : textures_of(material)) {
            const int image =
                use.texture < 0 ? -1 : model.textures[static_cast<std::size_t>(use.texture)].image;
            if (image >= 0) {
                is_used[static_cast<std::size_t>(image)] = true;
            }
        }
    }
    return is_used;
}

std::vector<SubMesh> sub_meshes(const Model& model) {
    std::vector<SubMesh> parts;
    for (const RestPart& rest : rest_parts(model)) {
        const ModelNode& node = model.nodes[static_cast<std::size_t>(rest.node)];
        const ModelPrimitive& primitive =
            model.meshes[static_cast<std::size_t>(node.mesh)].primitives[rest.primitive];
        SubMesh part{.node = rest.node,
                     .primitive = rest.primitive,
                     .vertices = primitive.positions.size(),
                     .triangles = primitive.indices.size() / 3,
                     .material = primitive.material,
                     .textures = texture_sizes(model, primitive.material),
                     .morphs = primitive.morphs.size(),
                     .box = rest.box};
        count_weights(primitive, part);
        parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(), [](const SubMesh& one, const SubMesh& other) {
        return one.node < other.node;
    });
    return parts;
}

}  // namespace raks::render
