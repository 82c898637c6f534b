// 3DS files, written chunk by chunk by the tests themselves.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/import/model_reader.hpp"

#include <glm/vec3.hpp>

namespace raks::test::tds {

/// Numbers as they lie in the file.
template <typename... T>
std::string raw(T... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
    return bytes;
}

inline std::string raw(const glm::vec3& v) { return raw(v.x, v.y, v.z); }

inline std::string text(std::string_view words) { return std::string(words) + '\0'; }

inline std::string chunk(int id, const std::string& body) {
    return raw(static_cast<std::uint16_t>(id), static_cast<std::uint32_t>(6 + body.size())) + body;
}

inline std::string count(std::size_t number) { return raw(static_cast<std::uint16_t>(number)); }

/// A mesh as it is written.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint16_t, 3>> triangles;
    std::vector<std::uint32_t> smoothing = {};
    std::vector<std::array<float, 2>> uv = {};
    std::string material = {};
    /// Axes and origin.
    std::array<glm::vec3, 4> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
};

inline std::string object(const Mesh& mesh) {
    std::string vertices = count(mesh.positions.size());
    for (const glm::vec3& place : mesh.positions) {
        vertices += raw(place);
    }
    std::string faces = count(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        faces += raw(triangle[0], triangle[1], triangle[2], std::uint16_t{7});
    }
    if (!mesh.material.empty()) {
        std::string group = text(mesh.material) + count(mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            group += count(i);
        }
        faces += chunk(0x4130, group);
    }
    if (!mesh.smoothing.empty()) {
        std::string groups;
        for (const std::uint32_t bits : mesh.smoothing) {
            groups += raw(bits);
        }
        faces += chunk(0x4150, groups);
    }
    std::string parts = chunk(0x4110, vertices) + chunk(0x4120, faces);
    if (!mesh.uv.empty()) {
        std::string places = count(mesh.uv.size());
        for (const auto& place : mesh.uv) {
            places += raw(place[0], place[1]);
        }
        parts += chunk(0x4140, places);
    }
    std::string axes;
    for (const glm::vec3& axis : mesh.axes) {
        axes += raw(axis);
    }
    return chunk(0x4000, text(mesh.name) + chunk(0x4100, parts + chunk(0x4160, axes)));
}

/// A box along the axes whose own axes begin at `origin`.
inline Mesh box(const std::string& name,
                const glm::vec3& centre,
                const glm::vec3& half,
                const glm::vec3& origin) {
    Mesh mesh{.name = name, .positions = {}, .triangles = {}};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 side((corner & 1) != 0 ? 1.0F : -1.0F,
                             (corner & 2) != 0 ? 1.0F : -1.0F,
                             (corner & 4) != 0 ? 1.0F : -1.0F);
        mesh.positions.push_back(centre + side * half);
    }
    mesh.triangles = {{0, 2, 1},
                      {1, 2, 3},
                      {4, 5, 6},
                      {5, 7, 6},
                      {0, 1, 4},
                      {1, 5, 4},
                      {2, 6, 3},
                      {3, 6, 7},
                      {0, 4, 2},
                      {2, 4, 6},
                      {1, 3, 5},
                      {3, 7, 5}};
    mesh.axes[3] = origin;
    return mesh;
}

inline std::string material(const std::string& name, const std::string& parts) {
    return chunk(0xAFFF, chunk(0xA000, text(name)) + parts);
}

/// A key of a track: its frame and what stands there.
struct Key {
    std::uint32_t frame = 0;
    std::vector<float> values;
};

inline std::string track(int id, const std::vector<Key>& keys) {
    std::string body = raw(std::uint16_t{0},
                           std::uint32_t{0},
                           std::uint32_t{0},
                           static_cast<std::uint32_t>(keys.size()));
    for (const Key& key : keys) {
        body += raw(key.frame, std::uint16_t{0});
        for (const float value : key.values) {
            body += raw(value);
        }
    }
    return chunk(id, body);
}

/// A node of the keyframer.
struct Node {
    std::string name;
    int id = -1;      ///< -1: it has none
    int parent = -1;  ///< -1: it is a root
    glm::vec3 place{0.0F};
    glm::vec3 pivot{0.0F};
    std::string instance = {};
    std::vector<Key> turns = {{0, {0.0F, 0.0F, 0.0F, 1.0F}}};
    std::vector<Key> places = {};  ///< instead of `place`
};

inline std::string node(const Node& from) {
    std::string body;
    if (from.id >= 0) {
        body += chunk(0xB030, raw(static_cast<std::uint16_t>(from.id)));
    }
    body += chunk(
        0xB010,
        text(from.name) + raw(std::uint32_t{0},
                              static_cast<std::uint16_t>(from.parent < 0 ? 0xFFFF : from.parent)));
    if (!from.instance.empty()) {
        body += chunk(0xB011, text(from.instance));
    }
    const std::vector<Key> places =
        from.places.empty() ? std::vector<Key>{{0, {from.place.x, from.place.y, from.place.z}}}
                            : from.places;
    body += chunk(0xB013, raw(from.pivot)) + track(0xB020, places) + track(0xB021, from.turns) +
            track(0xB022, {{0, {1.0F, 1.0F, 1.0F}}});
    return chunk(0xB002, body);
}

/// A whole file of what stands in the editor and in the keyframer; "" there: it has none.
inline std::string file(const std::string& editor, const std::string& keyframer = {}) {
    return chunk(0x4D4D,
                 chunk(0x0002, raw(std::uint32_t{3})) + chunk(0x3D3D, editor) +
                     (keyframer.empty() ? std::string() : chunk(0xB000, keyframer)));
}

inline Expected<render::Model> read(const std::string& bytes,
                                    const render::SideFiles& side = render::SideFiles()) {
    return render::read_model(std::as_bytes(std::span(bytes.data(), bytes.size())), "x.3ds", side);
}

/// A figure of boxes, 1.7 high, that faces -y: a box for each of the 15 bones that a dancer needs,
/// below one another. Hips and trunk are named, limbs as "UpArmL".
inline std::string figure() {
    struct Part {
        const char* name;
        int parent;
        glm::vec3 joint;
        glm::vec3 centre;
        glm::vec3 half;
    };
    const std::array<Part, 15> parts = {{
        {"Hips", -1, {0, 0, 0.95F}, {0, 0, 0.95F}, {0.16F, 0.09F, 0.08F}},
        {"Spine", 0, {0, 0, 1.05F}, {0, 0, 1.25F}, {0.17F, 0.1F, 0.2F}},
        {"Head", 1, {0, 0, 1.5F}, {0, 0, 1.6F}, {0.09F, 0.1F, 0.1F}},
        {"UpLegL", 0, {0.1F, 0, 0.9F}, {0.1F, 0, 0.7F}, {0.07F, 0.07F, 0.2F}},
        {"LowLegL", 3, {0.1F, 0, 0.5F}, {0.1F, 0, 0.3F}, {0.06F, 0.06F, 0.2F}},
        {"FootL", 4, {0.1F, 0, 0.1F}, {0.1F, -0.08F, 0.05F}, {0.05F, 0.13F, 0.05F}},
        {"UpLegR", 0, {-0.1F, 0, 0.9F}, {-0.1F, 0, 0.7F}, {0.07F, 0.07F, 0.2F}},
        {"LowLegR", 6, {-0.1F, 0, 0.5F}, {-0.1F, 0, 0.3F}, {0.06F, 0.06F, 0.2F}},
        {"FootR", 7, {-0.1F, 0, 0.1F}, {-0.1F, -0.08F, 0.05F}, {0.05F, 0.13F, 0.05F}},
        {"UpArmL", 1, {0.2F, 0, 1.4F}, {0.34F, 0, 1.4F}, {0.14F, 0.05F, 0.05F}},
        {"LowArmL", 9, {0.48F, 0, 1.4F}, {0.6F, 0, 1.4F}, {0.12F, 0.04F, 0.04F}},
        {"HandL", 10, {0.72F, 0, 1.4F}, {0.8F, 0, 1.4F}, {0.08F, 0.05F, 0.02F}},
        {"UpArmR", 1, {-0.2F, 0, 1.4F}, {-0.34F, 0, 1.4F}, {0.14F, 0.05F, 0.05F}},
        {"LowArmR", 12, {-0.48F, 0, 1.4F}, {-0.6F, 0, 1.4F}, {0.12F, 0.04F, 0.04F}},
        {"HandR", 13, {-0.72F, 0, 1.4F}, {-0.8F, 0, 1.4F}, {0.08F, 0.05F, 0.02F}},
    }};
    std::string editor;
    std::string keyframer;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        editor += object(box(part.name, part.centre, part.half, part.joint));
        const glm::vec3 above =
            part.parent < 0 ? glm::vec3(0.0F) : parts[static_cast<std::size_t>(part.parent)].joint;
        keyframer += node({.name = part.name,
                           .id = static_cast<int>(i),
                           .parent = part.parent,
                           .place = part.joint - above});
    }
    return file(editor, keyframer);
}

}  // namespace raks::test::tds
