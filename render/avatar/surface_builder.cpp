#include "render/avatar/surface_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "render/avatar/skin_split.hpp"
#include "render/avatar/vertex_frames.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::render {
namespace {

std::int16_t snorm16(float value) noexcept {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * 32767.0F));
}
std::uint16_t unorm16(float value) noexcept {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 65535.0F));
}

/// Weights as integers that sum to 65,535: the largest takes what rounding left.
std::array<std::uint16_t, 4> packed_weights(const std::array<float, 4>& weights) noexcept {
    std::array<std::uint16_t, 4> packed{};
    int sum = 0;
    for (std::size_t i = 0; i < packed.size(); ++i) {
        packed[i] = unorm16(weights[i]);
        sum += packed[i];
    }
    auto& largest = *std::max_element(packed.begin(), packed.end());
    largest = static_cast<std::uint16_t>(largest + 65'535 - sum);
    return packed;
}

/// Opaque, cut out, blended with depth, blended; within the blended ones by the maker's queue.
int drawing_order(const ModelMaterial& material) noexcept {
    if (material.alpha_mode != AlphaMode::blend) {
        return material.alpha_mode == AlphaMode::opaque ? 0 : 1;
    }
    constexpr int kBlended = 100;
    const bool writes_depth = material.mtoon && material.mtoon->transparent_with_z_write;
    const int queue = material.mtoon ? material.mtoon->render_queue_offset : 0;
    return (writes_depth ? kBlended : 2 * kBlended) + queue;
}

class SurfaceBuilder {
 public:
    SurfaceBuilder(const Model& model, const AvatarRig& rig, std::shared_ptr<SurfaceImages> images)
        : model_(model), rig_(rig) {
        surface_.materials = model.materials;
        surface_.textures = model.textures;
        const SurfaceImages::Images unpacked = images == nullptr ? nullptr : images->get();
        surface_.images = std::move(images);
        for (ModelTexture& texture : surface_.textures) {
            // What could not be read is drawn white.
            if (texture.image >= 0 &&
                (unpacked == nullptr ||
                 (*unpacked)[static_cast<std::size_t>(texture.image)].width == 0)) {
                texture.image = -1;
            }
        }
    }

    Surface build() {
        for (std::size_t node = 0; node < model_.nodes.size(); ++node) {
            if (model_.nodes[node].mesh >= 0 && rig_.tree.joint_of(static_cast<int>(node)) >= 0) {
                add_node(static_cast<int>(node));
            }
        }
        std::stable_sort(
            surface_.parts.begin(),
            surface_.parts.end(),
            [&](const SurfacePart& a, const SurfacePart& b) { return order_of(a) < order_of(b); });
        return std::move(surface_);
    }

 private:
    void add_node(int node);
    void add_primitive(int node, const ModelPrimitive& primitive, int skin);
    int skin_of_piece(int whole, const SkinnedPiece& piece);
    void add_vertices(const ModelPrimitive& primitive, bool has_skin);
    void add_morphs(int node, const ModelPrimitive& primitive, std::uint32_t first_vertex);
    int skin_of(int node);
    int default_material();

    /// Skins that were split are used no more.
    void drop_large_skins() {
        for (SurfaceSkin& skin : surface_.skins) {
            if (skin.joints.size() > SurfaceSkin::kMostJoints) {
                skin = {};
            }
        }
    }

    [[nodiscard]] int order_of(const SurfacePart& part) const noexcept {
        return drawing_order(surface_.materials[static_cast<std::size_t>(part.material)]);
    }

    const Model& model_;
    const AvatarRig& rig_;
    Surface surface_;
    std::map<int, int> skins_;                           // by the model's skin
    std::map<std::pair<int, int>, std::size_t> morphs_;  // by node and target
    int default_material_ = -1;
};

int SurfaceBuilder::default_material() {
    if (default_material_ < 0) {
        default_material_ = static_cast<int>(surface_.materials.size());
        surface_.materials.emplace_back();
    }
    return default_material_;
}

/// A model's skin, or one of the node alone.
int SurfaceBuilder::skin_of(int node) {
    const int skin = model_.nodes[static_cast<std::size_t>(node)].skin;
    if (skin >= 0) {
        const auto known = skins_.find(skin);
        if (known != skins_.end()) {
            return known->second;
        }
        skins_[skin] = static_cast<int>(surface_.skins.size());
    }
    SurfaceSkin& made = surface_.skins.emplace_back();
    if (skin < 0) {
        made = {.joints = {rig_.tree.joint_of(node)}, .inverse_bind = {glm::mat4(1.0F)}};
    } else {
        const ModelSkin& from = model_.skins[static_cast<std::size_t>(skin)];
        made.inverse_bind = from.inverse_bind;
        for (const int joint : from.joints) {
            made.joints.push_back(rig_.tree.joint_of(joint));
        }
    }
    return static_cast<int>(surface_.skins.size()) - 1;
}

void SurfaceBuilder::add_node(int node) {
    const ModelNode& from = model_.nodes[static_cast<std::size_t>(node)];
    const ModelMesh& mesh = model_.meshes[static_cast<std::size_t>(from.mesh)];
    const int skin = skin_of(node);
    const bool is_too_large =
        surface_.skins[static_cast<std::size_t>(skin)].joints.size() > SurfaceSkin::kMostJoints;
    for (const ModelPrimitive& primitive : mesh.primitives) {
        if (!is_too_large) {
            add_primitive(node, primitive, skin);
        } else if (!primitive.joints.empty()) {
            for (const SkinnedPiece& piece : split_by_joints(primitive, SurfaceSkin::kMostJoints)) {
                add_primitive(node, piece.primitive, skin_of_piece(skin, piece));
            }
        }
    }
}

/// The joints of a large skin that one piece uses.
int SurfaceBuilder::skin_of_piece(int whole, const SkinnedPiece& piece) {
    SurfaceSkin made;
    const SurfaceSkin& from = surface_.skins[static_cast<std::size_t>(whole)];
    for (const std::uint16_t joint : piece.joints) {
        made.joints.push_back(from.joints[joint]);
        made.inverse_bind.push_back(from.inverse_bind[joint]);
    }
    surface_.skins.push_back(std::move(made));
    return static_cast<int>(surface_.skins.size()) - 1;
}

void SurfaceBuilder::add_primitive(int node, const ModelPrimitive& primitive, int skin) {
    const SurfacePart part{
        .first_index = static_cast<std::uint32_t>(surface_.indices.size()),
        .index_count = static_cast<std::uint32_t>(primitive.indices.size()),
        .material = primitive.material >= 0 ? primitive.material : default_material(),
        .skin = skin};
    const auto first = static_cast<std::uint32_t>(surface_.vertices.size());
    for (const std::uint32_t index : primitive.indices) {
        surface_.indices.push_back(first + index);
    }
    const bool has_skin =
        model_.nodes[static_cast<std::size_t>(node)].skin >= 0 && !primitive.joints.empty();
    add_vertices(primitive, has_skin);
    add_morphs(node, primitive, first);
    surface_.parts.push_back(part);
}

void SurfaceBuilder::add_vertices(const ModelPrimitive& primitive, bool has_skin) {
    const std::vector<glm::vec3> normals =
        primitive.normals.empty() ? smooth_normals(primitive) : primitive.normals;
    const std::vector<glm::vec4> tangents =
        primitive.tangents.empty() ? made_tangents(primitive, normals) : primitive.tangents;
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        SurfaceVertex& vertex = surface_.vertices.emplace_back();
        const glm::vec3& p = primitive.positions[i];
        const glm::vec3& n = normals[i];
        vertex.position = {p.x, p.y, p.z};
        vertex.normal = {snorm16(n.x), snorm16(n.y), snorm16(n.z), 0};
        vertex.weights = {65'535, 0, 0, 0};
        if (has_skin) {
            vertex.joints = primitive.joints[i];
            vertex.weights = packed_weights(primitive.weights[i]);
        }
        if (!tangents.empty()) {
            const glm::vec4& t = tangents[i];
            vertex.tangent = {snorm16(t.x), snorm16(t.y), snorm16(t.z), snorm16(t.w)};
        }
        for (std::size_t set = 0; set < primitive.uv.size(); ++set) {
            if (!primitive.uv[set].empty()) {
                vertex.uv[2 * set] = primitive.uv[set][i].x;
                vertex.uv[2 * set + 1] = primitive.uv[set][i].y;
            }
        }
        if (!primitive.colours.empty()) {
            const glm::vec4& c = primitive.colours[i];
            vertex.colour = {unorm16(c.r), unorm16(c.g), unorm16(c.b), unorm16(c.a)};
        }
    }
}

/// The primitives of one mesh have the same targets: each adds its vertices.
void SurfaceBuilder::add_morphs(int node,
                                const ModelPrimitive& primitive,
                                std::uint32_t first_vertex) {
    const MorphRange range = rig_.expressions.morphs_of(node);
    for (std::size_t target = 0; target < std::min(primitive.morphs.size(), range.count);
         ++target) {
        const MorphTarget& from = primitive.morphs[target];
        if (from.vertices.empty()) {
            continue;
        }
        const auto [place, is_new] =
            morphs_.try_emplace({node, static_cast<int>(target)}, surface_.morphs.size());
        if (is_new) {
            surface_.morphs.push_back(
                {.weight = range.first + target, .vertices = {}, .positions = {}, .normals = {}});
        }
        SurfaceMorph& morph = surface_.morphs[place->second];
        for (std::size_t i = 0; i < from.vertices.size(); ++i) {
            morph.vertices.push_back(first_vertex + from.vertices[i]);
            morph.positions.push_back(from.positions[i]);
            morph.normals.push_back(from.normals.empty() ? glm::vec3(0.0F) : from.normals[i]);
        }
    }
}

}  // namespace

Surface build_surface(const Model& model,
                      const AvatarRig& rig,
                      std::shared_ptr<SurfaceImages> images) {
    return SurfaceBuilder(model, rig, std::move(images)).build();
}

}  // namespace raks::render
