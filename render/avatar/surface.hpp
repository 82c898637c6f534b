// The drawable surface of an avatar that was read from a file: textured triangles, what they are
// made of, and the joints that move them. OpenGL stays out: the arrays are uploaded as they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "render/avatar/surface_images.hpp"
#include "render/model/material.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// One vertex as uploaded, in the bind pose; 68 bytes, no padding.
///
///     offset  type        OpenGL attribute               is
///     0       float[3]    3 GL_FLOAT                     position, metres
///     12      int16[4]    4 GL_SHORT, normalized         unit normal; w = 0
///     20      uint16[4]   4 GL_UNSIGNED_SHORT, integer   joints of the part's skin
///     28      uint16[4]   4 GL_UNSIGNED_SHORT, norm.     weights, sum 65,535
///     36      int16[4]    4 GL_SHORT, normalized         unit tangent; w: side of the bitangent
///     44      float[4]    4 GL_FLOAT                     both texture coordinates: u, v, u, v
///     60      uint16[4]   4 GL_UNSIGNED_SHORT, norm.     colour, linear
struct SurfaceVertex {
    std::array<float, 3> position{};
    std::array<std::int16_t, 4> normal{};
    std::array<std::uint16_t, 4> joints{};
    std::array<std::uint16_t, 4> weights{};
    std::array<std::int16_t, 4> tangent{};
    std::array<float, 4> uv{};
    std::array<std::uint16_t, 4> colour{65'535, 65'535, 65'535, 65'535};
};
static_assert(sizeof(SurfaceVertex) == 68 && std::is_trivially_copyable_v<SurfaceVertex>);

/// Joints that move one part: a vertex's joint k is `joints[k]` of the avatar.
struct SurfaceSkin {
    /// What the uniform block of one part holds: 16 KiB of 3x4 matrices.
    static constexpr std::size_t kMostJoints = 341;

    std::vector<int> joints;
    std::vector<glm::mat4> inverse_bind;  ///< as many: joint from mesh
};

/// Triangles of one material that one skin moves.
struct SurfacePart {
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;  ///< a multiple of 3
    int material = 0;
    int skin = 0;
};

/// What a morph target adds to the vertices named: for an expression's bind.
struct SurfaceMorph {
    std::size_t weight = 0;  ///< in FaceState::morphs
    std::vector<std::uint32_t> vertices;
    std::vector<glm::vec3> positions;  ///< for each of them, in the vertex's own space
    std::vector<glm::vec3> normals;    ///< the same, or empty
};

/// Immutable once built. Indices are within their arrays.
struct Surface {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<SurfacePart> parts;  ///< in drawing order
    std::vector<SurfaceSkin> skins;
    std::vector<SurfaceMorph> morphs;
    std::vector<ModelMaterial> materials;
    std::vector<ModelTexture> textures;
    std::shared_ptr<SurfaceImages> images;  ///< null: no texture has one
};

}  // namespace raks::render
