#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "render/import/gltf_nodes.hpp"
#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostSkins = 2'000;
constexpr std::size_t kMostJoints = 20'000;
constexpr std::size_t kMostJointsInAll = 200'000;

std::vector<glm::mat4> read_inverse_binds(const JsonField& field,
                                          std::size_t joints,
                                          GltfAccessors& accessors,
                                          Model& model) {
    const int index = field.index_or_none(accessors.size());
    std::vector<glm::mat4> matrices(joints, glm::mat4(1.0F));
    if (index < 0 || accessors.size() == 0) {
        return matrices;
    }
    const GltfAccessor& accessor = accessors[index];
    if (accessor.element != ElementType::mat4 || accessor.component != ComponentType::float32 ||
        accessor.count < joints) {
        field.complain(fmt::format("must be {} matrices of floats, one for each joint", joints));
        return matrices;
    }
    if (accessor.count > joints) {
        warn(model, field.line("has more matrices than joints"));
    }
    accessors.use(index, ViewUse::matrices);
    std::vector<glm::mat4> all = accessors.elements<glm::mat4>(index);
    all.resize(joints, glm::mat4(1.0F));
    constexpr float kSlack = 1e-4F;
    for (glm::mat4& matrix : all) {
        const float off = std::abs(matrix[0][3]) + std::abs(matrix[1][3]) + std::abs(matrix[2][3]) +
                          std::abs(matrix[3][3] - 1.0F);
        if (off > kSlack) {
            warn(model, field.line("has a matrix whose last row is not 0 0 0 1"));
        }
        for (int column = 0; column < 4; ++column) {
            matrix[column][3] = column == 3 ? 1.0F : 0.0F;
        }
    }
    return all;
}

/// Answers what lies below what, in no time: nodes numbered as a walk meets them.
class NodeOrder {
 public:
    explicit NodeOrder(const Model& model)
        : first_(model.nodes.size()), last_(model.nodes.size()), top_(model.nodes.size()) {
        std::vector<int> open;
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (model.nodes[i].parent < 0) {
                open.push_back(static_cast<int>(i));
            }
        }
        std::vector<int> order;
        while (!open.empty()) {
            const int node = open.back();
            open.pop_back();
            const ModelNode& here = model.nodes[at(node)];
            first_[at(node)] = static_cast<int>(order.size());
            top_[at(node)] = here.parent < 0 ? node : top_[at(here.parent)];
            order.push_back(node);
            open.insert(open.end(), here.children.begin(), here.children.end());
        }
        // Children are met behind their parent: from the end on, all below a node are known.
        for (std::size_t i = order.size(); i-- > 0;) {
            const auto node = at(order[i]);
            last_[node] = std::max(last_[node], first_[node]);
            if (const int parent = model.nodes[node].parent; parent >= 0) {
                last_[at(parent)] = std::max(last_[at(parent)], last_[node]);
            }
        }
    }
    [[nodiscard]] int top_of(int node) const { return top_[at(node)]; }
    /// A node is below itself.
    [[nodiscard]] bool is_below(int node, int above) const {
        return first_[at(node)] >= first_[at(above)] && first_[at(node)] <= last_[at(above)];
    }

 private:
    static std::size_t at(int index) { return static_cast<std::size_t>(index); }
    std::vector<int> first_;  ///< number of the node
    std::vector<int> last_;   ///< largest number below it
    std::vector<int> top_;
};

/// What the specification asks for of a skin's joints, and what can be drawn without it.
void note_joints(const JsonField& field,
                 const ModelSkin& skin,
                 const NodeOrder& order,
                 Model& model) {
    if (std::set<int>(skin.joints.begin(), skin.joints.end()).size() != skin.joints.size()) {
        warn(model, field["joints"].line("a joint is listed twice"));
    }
    std::set<int> tops;
    for (const int joint : skin.joints) {
        tops.insert(order.top_of(joint));
    }
    if (tops.size() > 1) {
        warn(model, field["joints"].line("its joints have no common root"));
    }
    const bool is_shown = std::any_of(
        model.roots.begin(), model.roots.end(), [&](int root) { return tops.count(root) > 0; });
    if (!is_shown) {
        warn(model, field["joints"].line("its joints are not in the scene"));
    }
    const JsonField skeleton = field["skeleton"];
    if (!skeleton.exists()) {
        return;
    }
    const std::int64_t top = skeleton.whole(-1'000'000'000, 1'000'000'000);
    const bool is_above = top >= 0 && static_cast<std::size_t>(top) < model.nodes.size() &&
                          std::all_of(skin.joints.begin(), skin.joints.end(), [&](int joint) {
                              return order.is_below(joint, static_cast<int>(top));
                          });
    if (!is_above) {
        warn(model, skeleton.line("does not lie above all joints"));
    }
}

ModelSkin read_skin(const JsonField& field, GltfAccessors& accessors, Model& model) {
    ModelSkin skin;
    for (const JsonField& joint : field["joints"].items(kMostJoints)) {
        skin.joints.push_back(joint.index(model.nodes.size()));
    }
    if (skin.joints.empty() || model.nodes.empty()) {
        field.complain("has no joints");
        return skin;
    }
    skin.inverse_bind =
        read_inverse_binds(field["inverseBindMatrices"], skin.joints.size(), accessors, model);
    return skin;
}

/// Joints without weight that are not in the skin: never looked at, but indices all the same.
void drop_unused_joints(ModelMesh& mesh, std::size_t joints) {
    for (ModelPrimitive& primitive : mesh.primitives) {
        for (auto& four : primitive.joints) {
            for (std::uint16_t& joint : four) {
                joint = joint < joints ? joint : std::uint16_t{0};
            }
        }
    }
}

bool has_joints(const ModelMesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [](const auto& primitive) {
        return !primitive.joints.empty();
    });
}

/// That a node's mesh and skin fit.
void check_node(const JsonField& field,
                const ModelNode& node,
                const std::vector<MeshJoints>& asked,
                Model& model) {
    if (node.mesh < 0) {
        return;
    }
    const auto mesh = static_cast<std::size_t>(node.mesh);
    if (node.skin < 0) {
        if (has_joints(model.meshes[mesh])) {
            warn(model, field.line("its mesh has joints, but no skin moves them: it stands still"));
        }
        return;
    }
    if (!has_joints(model.meshes[mesh]) && !model.meshes[mesh].primitives.empty()) {
        warn(model, field.line("has a skin, but its mesh has no joints"));
    }
    const auto count =
        static_cast<int>(model.skins[static_cast<std::size_t>(node.skin)].joints.size());
    if (asked[mesh].used >= count) {
        field.complain(fmt::format("meshes[{}] names joint {}, but its skin has {} joints",
                                   mesh,
                                   asked[mesh].used,
                                   count));
    } else if (asked[mesh].unused >= count) {
        warn(
            model,
            field.line("its mesh names joints that its skin does not have, though without weight"));
        drop_unused_joints(model.meshes[mesh], static_cast<std::size_t>(count));
    }
}

}  // namespace

void read_skins(const JsonField& root,
                GltfAccessors& accessors,
                const std::vector<MeshJoints>& joints,
                Model& model) {
    const NodeOrder order(model);
    std::size_t count = 0;
    for (const JsonField& field : root["skins"].objects(kMostSkins)) {
        count += field["joints"].size();
        if (count > kMostJointsInAll) {
            field.complain(fmt::format("more than {} joints in all", kMostJointsInAll));
            return;
        }
        model.skins.push_back(read_skin(field, accessors, model));
        if (!model.skins.back().inverse_bind.empty()) {
            note_joints(field, model.skins.back(), order, model);
        }
    }
    const std::vector<JsonField> nodes = root["nodes"].items();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        check_node(nodes[i], model.nodes[i], joints, model);
    }
}

}  // namespace raks::render
