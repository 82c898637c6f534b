#include "render/import/gltf_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/printable.hpp"
#include "render/import/model_warnings.hpp"

#include <glm/gtc/matrix_access.hpp>
#include <glm/mat3x3.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kMostNodes = 20'000;
constexpr int kDeepest = 1'000;
constexpr float kFarthestNode = 1e7F;  // translations and scales beyond it are refused
constexpr float kNodeSlack = 1e-3F;

/// A rotation of length 1; identity for one of length 0, and not a number.
glm::quat unit(const std::array<float, 4>& q, const JsonField& field, Model& model) {
    const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-6F && length < 1e6F)) {
        warn(model, field.line("has a rotation of length 0, taken as none"));
        return {1.0F, 0.0F, 0.0F, 0.0F};
    }
    if (std::abs(length - 1.0F) > kNodeSlack) {
        warn(model, field.line("has a rotation that is not of length 1"));
    }
    return {q[3] / length, q[0] / length, q[1] / length, q[2] / length};
}

/// Translation, rotation and scale of a matrix, a mirrored axis as a negative scale in x.
void take_apart(const std::array<float, 16>& m,
                ModelNode& node,
                const JsonField& field,
                Model& model) {
    node.translation = {m[12], m[13], m[14]};
    glm::mat3 turn(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
    for (int axis = 0; axis < 3; ++axis) {
        node.scale[axis] = glm::length(turn[axis]);
    }
    if (node.scale.x <= 0.0F || node.scale.y <= 0.0F || node.scale.z <= 0.0F) {
        warn(model, field.line("has a matrix without inverse; its rotation is lost"));
        return;
    }
    if (glm::determinant(turn) < 0.0F) {
        node.scale.x = -node.scale.x;
    }
    for (int axis = 0; axis < 3; ++axis) {
        turn[axis] /= node.scale[axis];
    }
    const float shear = std::max({std::abs(glm::dot(turn[0], turn[1])),
                                  std::abs(glm::dot(turn[1], turn[2])),
                                  std::abs(glm::dot(turn[0], turn[2]))});
    if (shear > kNodeSlack || m[3] != 0.0F || m[7] != 0.0F || m[11] != 0.0F || m[15] != 1.0F) {
        warn(model, field.line("has a matrix that is more than translation, rotation and scale"));
    }
    node.rotation = glm::normalize(glm::quat_cast(turn));
}

bool is_within(const glm::vec3& v) {
    return std::abs(v.x) < kFarthestNode && std::abs(v.y) < kFarthestNode &&
           std::abs(v.z) < kFarthestNode;
}

void read_transform(const JsonField& field, ModelNode& node, Model& model) {
    const JsonField matrix = field["matrix"];
    const auto t = field["translation"].numbers_or<3>({0.0F, 0.0F, 0.0F});
    const auto r = field["rotation"].numbers_or<4>({0.0F, 0.0F, 0.0F, 1.0F});
    const auto s = field["scale"].numbers_or<3>({1.0F, 1.0F, 1.0F});
    node.translation = {t[0], t[1], t[2]};
    node.rotation = unit(r, field["rotation"], model);
    node.scale = {s[0], s[1], s[2]};
    if (matrix.exists()) {
        if (field["translation"].exists() || field["rotation"].exists() ||
            field["scale"].exists()) {
            warn(model, field.line("has both a matrix and translation, rotation or scale"));
        }
        take_apart(matrix.numbers_or<16>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
                   node,
                   matrix,
                   model);
    }
    if (!is_within(node.translation) || !is_within(node.scale)) {
        field.complain(fmt::format("is moved or scaled by more than {}", kFarthestNode));
    }
    if (node.scale.x == 0.0F || node.scale.y == 0.0F || node.scale.z == 0.0F) {
        warn(model, field.line("has a scale of 0"));
    }
}

ModelNode read_node(const JsonField& field, std::size_t skins, std::size_t cameras, Model& model) {
    ModelNode node;
    const std::string_view name = field["name"].text_or("");
    node.name = printable(name, 200);
    if (node.name != name) {
        warn(model,
             field["name"].line(
                 "is too long for a line, or holds control characters; shown in part"));
    }
    read_transform(field, node, model);
    node.mesh = field["mesh"].index_or_none(model.meshes.size());
    node.skin = field["skin"].index_or_none(skins);
    (void)field["camera"].index_or_none(cameras);
    if (node.mesh < 0 && (node.skin >= 0 || field["weights"].exists())) {
        warn(model, field.line("has a skin or weights, but no mesh"));
        node.skin = -1;
    }
    node.morph_weights = field["weights"].numbers(10'000);
    if (!node.morph_weights.empty() && node.mesh >= 0 && !model.meshes.empty()) {
        const std::size_t count =
            model.meshes[static_cast<std::size_t>(node.mesh)].morph_weights.size();
        if (count != node.morph_weights.size()) {
            warn(model,
                 field.line(fmt::format(
                     "has {} weights for {} morph targets", node.morph_weights.size(), count)));
        }
        node.morph_weights.resize(count, 0.0F);
    }
    return node;
}

void read_children(const JsonField& field, std::size_t index, Model& model) {
    if (field["children"].is_array() && field["children"].size() == 0) {
        warn(model, field.line("has an empty list of children"));
    }
    for (const JsonField& item : field["children"].items(kMostNodes)) {
        const int child = item.index(model.nodes.size());
        ModelNode& node = model.nodes[static_cast<std::size_t>(child)];
        if (node.parent >= 0) {
            item.complain(fmt::format("node {} has two parents, but may have one", child));
            return;
        }
        node.parent = static_cast<int>(index);
        model.nodes[index].children.push_back(child);
    }
}

/// A forest has every node below a root; what lies on a cycle is below none.
void check_is_forest(const JsonField& list, const Model& model) {
    std::vector<std::pair<int, int>> open;  // node, depth
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].parent < 0) {
            open.emplace_back(static_cast<int>(i), 1);
        }
    }
    std::size_t seen = 0;
    for (; seen < open.size(); ++seen) {
        const auto [node, depth] = open[seen];
        if (depth > kDeepest) {
            list.complain(fmt::format("has more than {} nodes below one another", kDeepest));
            return;
        }
        for (const int child : model.nodes[static_cast<std::size_t>(node)].children) {
            open.emplace_back(child, depth + 1);
        }
    }
    if (seen != model.nodes.size()) {
        list.complain("a node lies below itself");
    }
}

void take_all_roots(Model& model) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].parent < 0) {
            model.roots.push_back(static_cast<int>(i));
        }
    }
}

void read_scene(const JsonField& root, Model& model) {
    const std::vector<JsonField> scenes = root["scenes"].objects(kMostNodes);
    const int shown = root["scene"].index_or_none(scenes.size());
    if (scenes.empty()) {
        warn(model, "has no scene: all of it is shown");
        take_all_roots(model);
        return;
    }
    for (const JsonField& scene : scenes) {
        std::vector<int> roots;
        std::set<int> seen;
        for (const JsonField& item : scene["nodes"].items(kMostNodes)) {
            const int node = item.index(model.nodes.size());
            if (!model.nodes.empty() && model.nodes[static_cast<std::size_t>(node)].parent >= 0) {
                item.complain(
                    fmt::format("node {} has a parent, so that it cannot be listed here", node));
            } else if (!seen.insert(node).second) {
                warn(model, item.line("is listed twice"));
            } else {
                roots.push_back(node);
            }
        }
        if (roots.empty()) {
            warn(model, scene.line("is an empty scene"));
        }
        if (&scene == &scenes[static_cast<std::size_t>(std::max(shown, 0))]) {
            model.roots = roots;
        }
    }
}

void note_names(Model& model) {
    std::set<std::string_view> names;
    std::string_view twice;
    for (const ModelNode& node : model.nodes) {
        if (!node.name.empty() && !names.insert(node.name).second) {
            twice = node.name;
        }
    }
    if (!twice.empty()) {
        warn(model, fmt::format("several nodes have one name, such as \"{}\"", twice));
    }
}

}  // namespace

void read_nodes(const JsonField& root, std::size_t skins, Model& model) {
    const JsonField list = root["nodes"];
    const std::vector<JsonField> fields = list.objects(kMostNodes);
    const std::size_t cameras = root["cameras"].size();
    for (const JsonField& field : fields) {
        model.nodes.push_back(read_node(field, skins, cameras, model));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
        read_children(fields[i], i, model);
    }
    check_is_forest(list, model);
    read_scene(root, model);
    note_names(model);
}

}  // namespace raks::render
