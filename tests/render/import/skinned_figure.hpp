// A figure with a skin, made in code, and what programs do to such figures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/model/model.hpp"
#include "render/model/model_survey.hpp"
#include "tests/render/import/vrm_text.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace raks::test {

/// Binds a skin of all nodes as they stand, one mesh on a node of its own. `flesh`: by node, where
/// its flesh ends against it, in the world's axes; 0: it moves nothing.
inline void add_skin(render::Model& model, const std::vector<glm::vec3>& flesh) {
    const std::vector<glm::mat4> world = render::rest_world(model);
    render::ModelSkin skin;
    render::ModelPrimitive body;
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        skin.joints.push_back(static_cast<int>(node));
        skin.inverse_bind.push_back(glm::inverse(world[node]));
        for (const glm::vec3& off : {glm::vec3(0.02F, 0.0F, 0.0F),
                                     glm::vec3(-0.02F, 0.0F, 0.02F),
                                     glm::vec3(0.0F, 0.0F, -0.02F)}) {
            for (const float along : {0.1F, 0.5F, 1.0F}) {
                if (flesh[node] != glm::vec3(0.0F)) {
                    body.positions.push_back(glm::vec3(world[node][3]) + along * flesh[node] + off);
                    body.joints.push_back({static_cast<std::uint16_t>(node), 0, 0, 0});
                    body.weights.push_back({1.0F, 0.0F, 0.0F, 0.0F});
                }
            }
        }
    }
    for (std::uint32_t i = 0; i + 2 < body.positions.size(); i += 3) {
        body.indices.insert(body.indices.end(), {i, i + 1, i + 2});
    }
    model.skins = {std::move(skin)};
    model.meshes.assign(1, {});
    model.meshes[0].primitives.push_back(std::move(body));
    const int shown = add_node(model, "body", -1);
    model.nodes[static_cast<std::size_t>(shown)].mesh = 0;
    model.nodes[static_cast<std::size_t>(shown)].skin = 0;
}

/// Where the flesh of each node ends: at its first child, else where `ends` says.
inline std::vector<glm::vec3> flesh_to_children(
    const render::Model& model, const std::vector<std::pair<std::string, glm::vec3>>& ends) {
    std::vector<glm::vec3> flesh;
    for (const render::ModelNode& node : model.nodes) {
        flesh.push_back(node.children.empty()
                            ? glm::vec3(0.0F)
                            : model.nodes[static_cast<std::size_t>(node.children[0])].translation);
        for (const auto& [name, end] : ends) {
            flesh.back() = node.name.find(name) != std::string::npos ? end : flesh.back();
        }
    }
    return flesh;
}

/// The nodes of small_figure with toes, without hair, mesh and materials: 17 bones, 1.75 m tall.
inline render::Model figure_of_joints() {
    render::Model small = small_figure();
    render::Model model;
    for (const render::ModelNode& node : small.nodes) {
        if (node.name.rfind("hair", 0) != 0) {
            add_node(model, node.name, node.parent, node.translation);
        }
    }
    for (const char* const side : {"left", "right"}) {
        add_node(model,
                 std::string(side) + "Toes",
                 node_named(model, std::string(side) + "Foot"),
                 {0.0F, -0.04F, 0.15F});
    }
    return model;
}

/// Where its flesh ends.
inline std::vector<glm::vec3> flesh_of_figure(const render::Model& model) {
    return flesh_to_children(model,
                             {{"head", {0.0F, 0.15F, 0.0F}},
                              {"leftHand", {0.18F, 0.0F, 0.0F}},
                              {"rightHand", {-0.18F, 0.0F, 0.0F}},
                              {"Toes", {0.0F, -0.01F, 0.07F}}});
}

/// figure_of_joints with a skin. The mesh's space is the world.
inline render::Model skinned_figure() {
    render::Model model = figure_of_joints();
    add_skin(model, flesh_of_figure(model));
    return model;
}

/// Brings the mesh into a space of its own: its vertices are turned and scaled, its bind matrices
/// turn and scale back. It is drawn as before.
inline void move_mesh_space(render::Model& model, const glm::mat4& space) {
    for (glm::vec3& place : model.meshes[0].primitives[0].positions) {
        place = glm::vec3(space * glm::vec4(place, 1.0F));
    }
    for (glm::mat4& inverse : model.skins[0].inverse_bind) {
        inverse = inverse * glm::inverse(space);
    }
}

/// Calls the nodes "Bone.0" and so on.
inline void forget_names(render::Model& model) {
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        model.nodes[node].name = "Bone." + std::to_string(node);
    }
}

}  // namespace raks::test
