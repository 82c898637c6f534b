// A small figure without a file, and what VRM's extensions in a text make of it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "render/import/json_field.hpp"
#include "render/import/vrm.hpp"
#include "render/model/model.hpp"

namespace raks::test {

/// Adds a node below another (-1: at the top).
inline int add_node(render::Model& model,
                    const std::string& name,
                    int parent,
                    const glm::vec3& translation = glm::vec3(0.0F)) {
    const int node = static_cast<int>(model.nodes.size());
    render::ModelNode& added = model.nodes.emplace_back();
    added.name = name;
    added.parent = parent;
    added.translation = translation;
    if (parent >= 0) {
        model.nodes[static_cast<std::size_t>(parent)].children.push_back(node);
    } else {
        model.roots.push_back(node);
    }
    return node;
}

/// The node of a name; the first of several, -1: none.
inline int node_named(const render::Model& model, std::string_view name) {
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

/// 18 nodes: the 15 required bones by VRM's names and, below the head, hair1 > hair2 > hair3.
/// Stands in a T-pose, faces +z. The head shows a mesh with two morph targets. Two materials,
/// "skin" and "cloth", and three textures.
inline render::Model small_figure() {
    render::Model model;
    const int hips = add_node(model, "hips", -1, {0.0F, 1.0F, 0.0F});
    const int spine = add_node(model, "spine", hips, {0.0F, 0.2F, 0.0F});
    const int head = add_node(model, "head", spine, {0.0F, 0.4F, 0.0F});
    for (const float side : {1.0F, -1.0F}) {
        const std::string name = side > 0.0F ? "left" : "right";
        const int leg = add_node(model, name + "UpperLeg", hips, {0.1F * side, -0.05F, 0.0F});
        const int knee = add_node(model, name + "LowerLeg", leg, {0.0F, -0.45F, 0.0F});
        add_node(model, name + "Foot", knee, {0.0F, -0.45F, 0.0F});
        const int arm = add_node(model, name + "UpperArm", spine, {0.15F * side, 0.25F, 0.0F});
        const int elbow = add_node(model, name + "LowerArm", arm, {0.3F * side, 0.0F, 0.0F});
        add_node(model, name + "Hand", elbow, {0.25F * side, 0.0F, 0.0F});
    }
    const int hair = add_node(model, "hair1", head, {0.0F, 0.1F, -0.1F});
    add_node(model, "hair3", add_node(model, "hair2", hair, {0.0F, -0.1F, 0.0F}), {0, -0.1F, 0});
    render::ModelPrimitive primitive;
    primitive.positions = {{0, 0, 0}, {0.1F, 0, 0}, {0, 0.2F, 0}};
    primitive.indices = {0, 1, 2};
    primitive.morphs.resize(2);
    render::ModelMesh& mesh = model.meshes.emplace_back();
    mesh.primitives.push_back(primitive);
    mesh.morph_names = {"open", "shut"};
    model.nodes[static_cast<std::size_t>(head)].mesh = 0;
    model.materials.resize(2);
    model.materials[0].name = "skin";
    model.materials[1].name = "cloth";
    model.textures.resize(3);
    return model;
}

/// `"hips":{"node":0}, ...` of all nodes of small_figure that are bones.
inline std::string bones1(const render::Model& model) {
    std::string bones;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].name.rfind("hair", 0) != 0) {
            bones += fmt::format(
                R"({}"{}":{{"node":{}}})", bones.empty() ? "" : ",", model.nodes[i].name, i);
        }
    }
    return bones;
}

/// The same as VRM 0.x writes it.
inline std::string bones0(const render::Model& model) {
    std::string bones;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (model.nodes[i].name.rfind("hair", 0) != 0) {
            bones += fmt::format(
                R"({}{{"bone":"{}","node":{}}})", bones.empty() ? "" : ",", model.nodes[i].name, i);
        }
    }
    return bones;
}

/// What was read, or why not.
struct ReadFigure {
    render::Model model;
    std::string error;  ///< empty: it was read

    /// Whether a warning holds the words.
    [[nodiscard]] bool warns(std::string_view words) const {
        return std::any_of(
            model.warnings.begin(), model.warnings.end(), [words](const std::string& line) {
                return line.find(words) != std::string::npos;
            });
    }
};

/// Reads a whole glTF text for a model whose nodes are there already.
inline ReadFigure read_document(std::string_view text, render::Model model) {
    ReadFigure read{.model = std::move(model), .error = {}};
    const auto document = render::JsonDocument::parse(text);
    if (!document) {
        read.error = document.error().message;
        return read;
    }
    render::JsonFaults faults;
    if (const auto done = render::read_character(document->root(faults), read.model); !done) {
        read.error = done.error().message;
    } else if (const auto sound = faults.finish(); !sound) {
        read.error = sound.error().message;
    }
    return read;
}

/// Reads small_figure as VRM 1.0. `more`: fields of VRMC_vrm after the bones, with a comma in
/// front; `others`: the same of `extensions`; `root`: the same of the document.
inline ReadFigure read_vrm1_text(const std::string& more = "",
                                 const std::string& others = "",
                                 const std::string& root = "") {
    render::Model model = small_figure();
    const std::string text = fmt::format(
        R"({{"extensions":{{"VRMC_vrm":{{"specVersion":"1.0","humanoid":{{"humanBones":{{{}}}}}{}}}{}}}{}}})",
        bones1(model),
        more,
        others,
        root);
    return read_document(text, std::move(model));
}

/// The same as VRM 0.x; `more`: fields of VRM after the bones.
inline ReadFigure read_vrm0_text(const std::string& more = "") {
    render::Model model = small_figure();
    const std::string text =
        fmt::format(R"({{"extensions":{{"VRM":{{"humanoid":{{"humanBones":[{}]}}{}}}}}}})",
                    bones0(model),
                    more);
    return read_document(text, std::move(model));
}

}  // namespace raks::test
