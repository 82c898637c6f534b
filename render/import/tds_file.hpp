// What a 3DS file says, chunk by chunk: z up, in its own terms.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// Triangles of one material.
struct TdsFaceGroup {
    std::string material;  ///< name
    std::vector<std::uint16_t> triangles;
};

/// An object with a mesh.
struct TdsObject {
    std::string name;
    std::vector<glm::vec3> positions;  ///< in the world, as it was modelled
    std::vector<glm::vec2> uv;         ///< v up; as many as positions, or none
    std::vector<std::array<std::uint16_t, 3>> triangles;
    std::vector<std::uint32_t> smoothing;  ///< bits: groups of each triangle; as many, or none
    std::vector<TdsFaceGroup> groups;
    glm::mat4 world_from_object{1.0F};
};

/// A material.
struct TdsMaterial {
    std::string name;
    glm::vec3 diffuse{0.6F};      ///< sRGB, 0..1
    float transparency = 0.0F;    ///< 0..1
    float self_light = 0.0F;      ///< 0..1
    float shininess = 0.0F;       ///< 0..1
    float shine_strength = 0.0F;  ///< 0..1
    bool is_two_sided = false;
    std::string texture;            ///< file of the diffuse colour; empty: none
    float texture_strength = 1.0F;  ///< 0..1
    bool is_tiled = true;
    bool is_mirrored = false;
    glm::vec2 uv_scale{1.0F};
    glm::vec2 uv_offset{0.0F};
    std::size_t other_textures = 0;  ///< bumps, reflections and so on
};

/// A key of a track and how the curve goes through it (Kochanek and Bartels).
template <typename Value>
struct TdsKey {
    std::uint32_t frame = 0;
    float tension = 0.0F;
    float continuity = 0.0F;
    float bias = 0.0F;
    Value value{};
};

/// A turn about an axis, clockwise seen against it; after the key before.
struct TdsTurn {
    float angle = 0.0F;  ///< radians
    glm::vec3 axis{0.0F};
};

enum class TdsNodeKind : std::uint8_t { object, camera, target, light, other };

/// A node of the keyframer. World at a time = parent x translation x turn x scale; the mesh hangs
/// in it by world x translation(-pivot) x object from world.
struct TdsNode {
    TdsNodeKind kind = TdsNodeKind::object;
    std::string name;      ///< of its object; "$$$DUMMY" where it has none
    std::string instance;  ///< its own name, or empty
    std::optional<std::uint16_t> id;
    std::optional<std::uint16_t> parent;  ///< an id
    glm::vec3 pivot{0.0F};
    std::vector<TdsKey<glm::vec3>> positions;
    std::vector<TdsKey<TdsTurn>> turns;
    std::vector<TdsKey<glm::vec3>> scales;
};

struct TdsFile {
    std::uint32_t version = 3;
    std::vector<TdsMaterial> materials;
    std::vector<TdsObject> objects;
    std::vector<TdsNode> nodes;
    std::size_t cameras = 0;
    std::size_t lights = 0;
    std::vector<std::string> notes;  ///< what was left out; the first ones

    /// Adds a line to the notes, unless there are many.
    void note(std::string line);
};

inline constexpr std::size_t kMostTdsNodes = 20'000;  ///< and objects, and materials

/// Takes a file apart. All claims of lengths and counts are compared with the bytes that there are;
/// corners and triangles are within their meshes. Errors: "chunk 4110 at byte 92: says 65535
/// entries, there is room for 8"; no 3DS file; no mesh in it; more than 20,000 nodes, objects or
/// materials.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<TdsFile> parse_tds(std::span<const std::byte> bytes);

}  // namespace raks::render
