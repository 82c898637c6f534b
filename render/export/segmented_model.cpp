#include "render/export/segmented_model.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "render/model/model_survey.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

std::size_t place_of(int index) { return static_cast<std::size_t>(index); }

/// Nodes with parents before children.
std::vector<int> nodes_from_roots(const Model& model) {
    std::vector<int> order = model.roots;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& children = model.nodes[place_of(order[i])].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    return order;
}

/// Cuts a model.
class Segments {
 public:
    explicit Segments(const Model& model)
        : model_(model),
          world_(rest_world(model)),
          order_(nodes_from_roots(model)),
          carrier_(model.nodes.size(), -1),
          parts_(model.nodes.size()) {
        find_carriers();
        for (const int node : order_) {
            if (model.nodes[place_of(node)].mesh >= 0) {
                cut(node);
            }
        }
    }

    [[nodiscard]] Model model() const {
        Model made;
        made.name = model_.name;
        made.materials = model_.materials;
        made.textures = model_.textures;
        made.images = model_.images;
        made.warnings = model_.warnings;
        made.character.licence = model_.character.licence;
        made.character.faces_minus_z = model_.character.faces_minus_z;
        std::vector<int> number(model_.nodes.size(), -1);
        const std::vector<bool> is_kept = kept();
        for (const int node : order_) {
            if (is_kept[place_of(node)]) {
                number[place_of(node)] = static_cast<int>(made.nodes.size());
                add_node(node, number, made);
            }
        }
        const HumanoidMap& humanoid = model_.character.humanoid;
        for (std::size_t bone = 0; bone < humanoid.nodes.size(); ++bone) {
            if (humanoid.nodes[bone] >= 0) {
                made.character.humanoid.nodes[bone] = number[place_of(humanoid.nodes[bone])];
                made.character.humanoid.axes[bone] = humanoid.axes[bone];
            }
        }
        return made;
    }

 private:
    /// Triangles of a part by their material, in the node's own axes.
    using Part = std::map<int, ModelPrimitive>;

    /// For each node the one whose part it belongs to: the bone above it, or itself.
    void find_carriers() {
        std::vector<bool> is_bone(model_.nodes.size(), false);
        for (const int node : model_.character.humanoid.nodes) {
            if (node >= 0) {
                is_bone[place_of(node)] = true;
            }
        }
        for (const int node : order_) {
            const int parent = model_.nodes[place_of(node)].parent;
            const int above = parent < 0 ? -1 : carrier_[place_of(parent)];
            const bool has_bone_above = above >= 0 && is_bone[place_of(above)];
            carrier_[place_of(node)] = is_bone[place_of(node)] || !has_bone_above ? node : above;
        }
    }

    /// How much each carrier weighs at a corner.
    void weigh(const ModelPrimitive& primitive,
               const ModelSkin& skin,
               std::uint32_t vertex,
               std::map<int, float>& weights) const {
        for (std::size_t i = 0; i < 4; ++i) {
            const float weight = primitive.weights[vertex][i];
            if (weight > 0.0F) {
                const int joint = skin.joints[primitive.joints[vertex][i]];
                weights[carrier_[place_of(joint)]] += weight;
            }
        }
    }

    int heaviest(const ModelPrimitive& primitive,
                 const ModelSkin& skin,
                 std::size_t triangle) const {
        std::map<int, float> weights;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            weigh(primitive, skin, primitive.indices[triangle + corner], weights);
        }
        const auto most =
            std::max_element(weights.begin(), weights.end(), [](const auto& a, const auto& b) {
                return a.second < b.second;
            });
        return most == weights.end() ? carrier_[place_of(skin.joints.front())] : most->first;
    }

    /// World from mesh at a vertex.
    [[nodiscard]] glm::mat4 matrix_at(const ModelPrimitive& primitive,
                                      const ModelSkin& skin,
                                      std::uint32_t vertex) const {
        glm::mat4 matrix(0.0F);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t joint = primitive.joints[vertex][i];
            const float weight = primitive.weights[vertex][i];
            if (weight > 0.0F) {
                matrix +=
                    weight * (world_[place_of(skin.joints[joint])] * skin.inverse_bind[joint]);
            }
        }
        return matrix;
    }

    void cut(int index) {
        const ModelNode& node = model_.nodes[place_of(index)];
        for (const ModelPrimitive& primitive : model_.meshes[place_of(node.mesh)].primitives) {
            const bool is_skinned = node.skin >= 0 && !primitive.joints.empty();
            std::map<std::pair<int, std::uint32_t>, std::uint32_t> known;
            for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
                const int to = is_skinned
                                   ? heaviest(primitive, model_.skins[place_of(node.skin)], t)
                                   : carrier_[place_of(index)];
                ModelPrimitive& made = parts_[place_of(to)][primitive.material];
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    const std::uint32_t vertex = primitive.indices[t + corner];
                    const auto [place, is_new] = known.try_emplace(
                        {to, vertex}, static_cast<std::uint32_t>(made.positions.size()));
                    if (is_new) {
                        const glm::mat4 from_mesh =
                            is_skinned
                                ? matrix_at(primitive, model_.skins[place_of(node.skin)], vertex)
                                : world_[place_of(index)];
                        add_vertex(primitive,
                                   vertex,
                                   glm::inverse(world_[place_of(to)]) * from_mesh,
                                   made);
                    }
                    made.indices.push_back(place->second);
                }
            }
        }
    }

    /// Arrays that a primitive lacks are filled, as others of the same part and material may have
    /// them.
    static void add_vertex(const ModelPrimitive& from,
                           std::uint32_t vertex,
                           const glm::mat4& matrix,
                           ModelPrimitive& to) {
        to.positions.emplace_back(matrix * glm::vec4(from.positions[vertex], 1.0F));
        const glm::vec3 normal =
            from.normals.empty()
                ? glm::vec3(0.0F)
                : glm::transpose(glm::inverse(glm::mat3(matrix))) * from.normals[vertex];
        const float length = glm::length(normal);
        to.normals.push_back(length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F));
        to.uv[0].push_back(from.uv[0].empty() ? glm::vec2(0.0F) : from.uv[0][vertex]);
    }

    /// Bones, what carries a mesh, and all above them.
    [[nodiscard]] std::vector<bool> kept() const {
        std::vector<bool> is_kept(model_.nodes.size(), false);
        for (const int node : model_.character.humanoid.nodes) {
            if (node >= 0) {
                is_kept[place_of(node)] = true;
            }
        }
        for (auto node = order_.rbegin(); node != order_.rend(); ++node) {
            const bool is_here = is_kept[place_of(*node)] || !parts_[place_of(*node)].empty();
            is_kept[place_of(*node)] = is_here;
            const int parent = model_.nodes[place_of(*node)].parent;
            if (is_here && parent >= 0) {
                is_kept[place_of(parent)] = true;
            }
        }
        return is_kept;
    }

    void add_node(int index, const std::vector<int>& number, Model& made) const {
        const ModelNode& from = model_.nodes[place_of(index)];
        const auto here = static_cast<int>(made.nodes.size());
        ModelNode node;
        node.name = from.name;
        node.translation = from.translation;
        node.rotation = from.rotation;
        node.scale = from.scale;
        node.parent = from.parent < 0 ? -1 : number[place_of(from.parent)];
        if (node.parent >= 0) {
            made.nodes[place_of(node.parent)].children.push_back(here);
        } else {
            made.roots.push_back(here);
        }
        if (const Part& part = parts_[place_of(index)]; !part.empty()) {
            node.mesh = static_cast<int>(made.meshes.size());
            ModelMesh mesh;
            mesh.name = from.name;
            for (const auto& [material, primitive] : part) {
                mesh.primitives.push_back(primitive);
                mesh.primitives.back().material = material;
            }
            made.meshes.push_back(std::move(mesh));
        }
        made.nodes.push_back(std::move(node));
    }

    const Model& model_;
    std::vector<glm::mat4> world_;
    std::vector<int> order_;
    std::vector<int> carrier_;
    std::vector<Part> parts_;
};

}  // namespace

Model segmented_model(const Model& model) { return Segments(model).model(); }

}  // namespace raks::render
