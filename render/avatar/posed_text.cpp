#include "render/avatar/posed_text.hpp"

#include <fmt/format.h>

#include <iterator>
#include <span>
#include <vector>

#include "base/printable.hpp"
#include "render/avatar/skin_vertices.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

// Minus zero reads as a difference where there is none.
float plain(float x) noexcept { return x + 0.0F; }

void add_vertices(const PosedVertices& part, std::string& text) {
    auto out = std::back_inserter(text);
    for (const glm::vec3& p : part.positions) {
        fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}\n", plain(p.x), plain(p.y), plain(p.z));
    }
    for (const glm::vec3& n : part.normals) {
        const float length = glm::length(n);
        const glm::vec3 unit = length > 0.0F ? n / length : glm::vec3(0.0F, 1.0F, 0.0F);
        fmt::format_to(
            out, "vn {:.4f} {:.4f} {:.4f}\n", plain(unit.x), plain(unit.y), plain(unit.z));
    }
}

// How many vertices and normals came before: OBJ counts on from part to part, from 1.
struct Counts {
    std::size_t vertices = 0;
    std::size_t normals = 0;
};

void add_faces(const ModelPrimitive& primitive, const Counts& before, std::string& text) {
    auto out = std::back_inserter(text);
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        text += "f";
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t index = primitive.indices[i + k] + 1;
            if (primitive.normals.empty()) {
                fmt::format_to(out, " {}", before.vertices + index);
            } else {
                fmt::format_to(out, " {}//{}", before.vertices + index, before.normals + index);
            }
        }
        text += "\n";
    }
}

/// A material's name without the spaces that would end it, and with its number: names may repeat.
std::string name_of(const Model& model, int material) {
    std::string name = model.materials[static_cast<std::size_t>(material)].name;
    for (char& letter : name) {
        const bool is_plain = (letter >= '0' && letter <= '9') ||
                              (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z');
        letter = is_plain ? letter : '_';
    }
    return fmt::format("{}_{}", material, name);
}

}  // namespace

std::string mtl_text(const Model& model) {
    std::string text;
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        const glm::vec4& colour = model.materials[i].base_colour;
        fmt::format_to(std::back_inserter(text),
                       "newmtl {}\nKd {:.6f} {:.6f} {:.6f}\nd {:.6f}\nillum 1\n",
                       name_of(model, static_cast<int>(i)),
                       colour.r,
                       colour.g,
                       colour.b,
                       colour.a);
    }
    return text;
}

std::string obj_text(const Model& model,
                     const AvatarRig& rig,
                     const RigState& state,
                     const std::string& title,
                     const std::string& materials) {
    std::string text = fmt::format("# {}\n", printable(title));
    if (!materials.empty()) {
        text += fmt::format("mtllib {}\n", materials);
    }
    Counts counts;
    PosedVertices part;
    for (const int node : rig.tree.nodes) {
        const int mesh = model.nodes[static_cast<std::size_t>(node)].mesh;
        if (mesh < 0) {
            continue;
        }
        std::vector<glm::mat4> matrices(matrix_count(model, node));
        skinning_matrices(model, rig.tree, state.joints, node, matrices);
        const MorphRange range = rig.expressions.morphs_of(node);
        const auto morphs = std::span(state.face.morphs).subspan(range.first, range.count);
        int index = 0;
        for (const ModelPrimitive& primitive :
             model.meshes[static_cast<std::size_t>(mesh)].primitives) {
            pose_vertices(primitive, morphs, matrices, part);
            fmt::format_to(
                std::back_inserter(text), "o node{}.mesh{}.primitive{}\n", node, mesh, index++);
            if (!materials.empty() && primitive.material >= 0) {
                text += fmt::format("usemtl {}\n", name_of(model, primitive.material));
            }
            add_vertices(part, text);
            add_faces(primitive, counts, text);
            counts.vertices += part.positions.size();
            counts.normals += part.normals.size();
        }
    }
    return text;
}

std::string joint_heads() { return "frame\tnode\tname\tx\ty\tz\n"; }

std::string joint_lines(const AvatarRig& rig, const RigState& state, std::size_t frame) {
    std::string text;
    for (std::size_t i = 0; i < rig.tree.joints.size(); ++i) {
        const glm::vec3 place(state.joints.world[i][3]);
        fmt::format_to(std::back_inserter(text),
                       "{}\t{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}\n",
                       frame,
                       rig.tree.nodes[i],
                       printable(rig.tree.joints[i].name),
                       plain(place.x),
                       plain(place.y),
                       plain(place.z));
    }
    return text;
}

}  // namespace raks::render
