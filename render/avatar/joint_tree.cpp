#include "render/avatar/joint_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raks::render {
namespace {

// Half a turn about y.
constexpr glm::quat kHalfTurn{0.0F, 0.0F, 1.0F, 0.0F};

glm::mat4 local_matrix(const JointState& state, std::size_t i) noexcept {
    glm::mat4 local = glm::mat4_cast(state.rotations[i]);
    for (int column = 0; column < 3; ++column) {
        local[column] *= state.scales[i][column];
    }
    local[3] = glm::vec4(state.translations[i], 1.0F);
    return local;
}

int root_above(const Model& model, int node) {
    int root = node;
    while (model.nodes[static_cast<std::size_t>(root)].parent >= 0) {
        root = model.nodes[static_cast<std::size_t>(root)].parent;
    }
    return root;
}

// The shown roots, and those above joints of skins that lie outside of the scene.
std::vector<int> needed_roots(const Model& model) {
    std::vector<int> roots = model.roots;
    for (const ModelSkin& skin : model.skins) {
        for (const int node : skin.joints) {
            const int root = root_above(model, node);
            // A root of the scene may be below a node that is not in it.
            const bool is_known = std::any_of(model.roots.begin(), model.roots.end(), [&](int r) {
                return root_above(model, r) == root;
            });
            if (!is_known && std::find(roots.begin(), roots.end(), root) == roots.end()) {
                roots.push_back(root);
            }
        }
    }
    return roots;
}

Joint joint_from(const ModelNode& node, int parent) {
    return {.name = node.name,
            .parent = parent,
            .translation = node.translation,
            .rotation = node.rotation,
            .scale = node.scale};
}

// Turned and scaled from outside.
void place_root(const Model& model, float scale, Joint& root) {
    if (model.character.faces_minus_z) {
        root.translation = kHalfTurn * root.translation;
        root.rotation = kHalfTurn * root.rotation;
    }
    root.translation *= scale;
    root.scale *= scale;
}

}  // namespace

JointTree build_joint_tree(const Model& model, float scale) {
    JointTree tree;
    tree.scale = scale;
    tree.joint_of_node.assign(model.nodes.size(), -1);
    std::vector<std::pair<int, int>> open;  // node, joint of its parent; the last one is next
    const std::vector<int> roots = needed_roots(model);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        open.emplace_back(*root, -1);
    }
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        int& joint = tree.joint_of_node[static_cast<std::size_t>(node)];
        if (joint >= 0) {
            continue;
        }
        joint = static_cast<int>(tree.joints.size());
        const ModelNode& source = model.nodes[static_cast<std::size_t>(node)];
        tree.joints.push_back(joint_from(source, parent));
        tree.nodes.push_back(node);
        if (parent < 0) {
            place_root(model, scale, tree.joints.back());
        }
        for (auto child = source.children.rbegin(); child != source.children.rend(); ++child) {
            open.emplace_back(*child, joint);
        }
    }
    return tree;
}

void go_to_rest(std::span<const Joint> joints, JointState& state) noexcept {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        state.translations[i] = joints[i].translation;
        state.rotations[i] = joints[i].rotation;
        state.scales[i] = joints[i].scale;
    }
}

JointState rest_state(std::span<const Joint> joints) {
    JointState state;
    state.translations.resize(joints.size());
    state.rotations.resize(joints.size());
    state.scales.resize(joints.size());
    state.world.resize(joints.size());
    go_to_rest(joints, state);
    update_world(joints, state);
    return state;
}

JointState t_pose_state(const Model& model,
                        const JointTree& tree,
                        std::span<const glm::quat> t_pose) {
    JointState state = rest_state(tree.joints);
    if (t_pose.empty()) {
        return state;
    }
    for (std::size_t i = 0; i < tree.joints.size(); ++i) {
        const auto node = static_cast<std::size_t>(tree.nodes[i]);
        // The joint's rotation may hold the turn of a root, too.
        state.rotations[i] =
            tree.joints[i].rotation * glm::inverse(model.nodes[node].rotation) * t_pose[node];
    }
    update_world(tree.joints, state);
    return state;
}

void update_world_of(std::span<const Joint> joints, JointState& state, std::size_t joint) noexcept {
    const glm::mat4 local = local_matrix(state, joint);
    const int parent = joints[joint].parent;
    state.world[joint] = parent < 0 ? local : state.world[static_cast<std::size_t>(parent)] * local;
}

void update_world(std::span<const Joint> joints, JointState& state, std::size_t first) noexcept {
    for (std::size_t i = first; i < joints.size(); ++i) {
        update_world_of(joints, state, i);
    }
}

glm::mat4 compute_world(std::span<const Joint> joints,
                        const JointState& state,
                        std::size_t joint) noexcept {
    glm::mat4 world = local_matrix(state, joint);
    for (int above = joints[joint].parent; above >= 0;) {
        const auto i = static_cast<std::size_t>(above);
        world = local_matrix(state, i) * world;
        above = joints[i].parent;
    }
    return world;
}

glm::quat rotation_of(const glm::mat4& matrix) noexcept {
    glm::mat3 axes(matrix);
    for (int column = 0; column < 3; ++column) {
        const float length = glm::length(axes[column]);
        if (!(length > 0.0F)) {
            return {1.0F, 0.0F, 0.0F, 0.0F};
        }
        axes[column] /= length;
    }
    return glm::normalize(glm::quat_cast(axes));
}

NodePlace place_of(const glm::mat4& matrix) noexcept {
    NodePlace place{.translation = glm::vec3(matrix[3]),
                    .rotation = rotation_of(matrix),
                    .scale = {glm::length(glm::vec3(matrix[0])),
                              glm::length(glm::vec3(matrix[1])),
                              glm::length(glm::vec3(matrix[2]))}};
    if (glm::determinant(glm::mat3(matrix)) < 0.0F) {
        glm::mat4 axes = matrix;
        axes[0] = -axes[0];
        place.rotation = rotation_of(axes);
        place.scale.x = -place.scale.x;
    }
    return place;
}

float scale_of(const glm::mat4& matrix) noexcept {
    return std::sqrt(std::max({glm::dot(matrix[0], matrix[0]),
                               glm::dot(matrix[1], matrix[1]),
                               glm::dot(matrix[2], matrix[2])}));
}

glm::quat shortest_turn(const glm::vec3& from, const glm::vec3& to) noexcept {
    constexpr float kOpposite = -0.999999F;
    const float cosine = glm::dot(from, to);
    if (cosine < kOpposite) {
        // Half a turn about any axis across `from`.
        const glm::vec3 other =
            std::abs(from.x) < 0.7F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
        return {0.0F, glm::normalize(glm::cross(from, other))};
    }
    return glm::normalize(glm::quat(1.0F + cosine, glm::cross(from, to)));
}

}  // namespace raks::render
