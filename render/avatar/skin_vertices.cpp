#include "render/avatar/skin_vertices.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace raks::render {
namespace {

using Joints = std::array<std::uint16_t, 4>;
using Weights = std::array<float, 4>;

#if defined(__SSE2__)

// A matrix in registers, by column.
struct Columns {
    __m128 c[4];
};

const float* column(const glm::mat4& matrix, int index) noexcept { return &matrix[index][0]; }

Columns blend(std::span<const glm::mat4> matrices,
              const Joints& joints,
              const Weights& weights) noexcept {
    Columns sum{};
    const glm::mat4& first = matrices[joints[0]];
    const __m128 w = _mm_set1_ps(weights[0]);
    for (int i = 0; i < 4; ++i) {
        sum.c[i] = _mm_mul_ps(w, _mm_loadu_ps(column(first, i)));
    }
    for (std::size_t k = 1; k < 4; ++k) {
        if (weights[k] == 0.0F) {
            continue;
        }
        const glm::mat4& matrix = matrices[joints[k]];
        const __m128 part = _mm_set1_ps(weights[k]);
        for (int i = 0; i < 4; ++i) {
            sum.c[i] = _mm_add_ps(sum.c[i], _mm_mul_ps(part, _mm_loadu_ps(column(matrix, i))));
        }
    }
    return sum;
}

glm::vec3 stored(__m128 v) noexcept {
    std::array<float, 4> values{};
    _mm_storeu_ps(values.data(), v);
    return {values[0], values[1], values[2]};
}

__m128 turned(const Columns& m, const glm::vec3& v) noexcept {
    return _mm_add_ps(
        _mm_add_ps(_mm_mul_ps(m.c[0], _mm_set1_ps(v.x)), _mm_mul_ps(m.c[1], _mm_set1_ps(v.y))),
        _mm_mul_ps(m.c[2], _mm_set1_ps(v.z)));
}

glm::vec3 direction(const Columns& m, const glm::vec3& v) noexcept { return stored(turned(m, v)); }

glm::vec3 place(const Columns& m, const glm::vec3& v) noexcept {
    return stored(_mm_add_ps(turned(m, v), m.c[3]));
}

#else

using Columns = glm::mat4;

Columns blend(std::span<const glm::mat4> matrices,
              const Joints& joints,
              const Weights& weights) noexcept {
    glm::mat4 sum = weights[0] * matrices[joints[0]];
    for (std::size_t k = 1; k < 4; ++k) {
        sum += weights[k] * matrices[joints[k]];
    }
    return sum;
}

glm::vec3 direction(const Columns& m, const glm::vec3& v) noexcept {
    return glm::vec3(m * glm::vec4(v, 0.0F));
}

glm::vec3 place(const Columns& m, const glm::vec3& v) noexcept {
    return glm::vec3(m * glm::vec4(v, 1.0F));
}

#endif

void add_morph(const MorphTarget& morph, float weight, PosedVertices& out) {
    for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
        out.positions[morph.vertices[i]] += weight * morph.positions[i];
    }
    if (morph.normals.empty() || out.normals.empty()) {
        return;
    }
    for (std::size_t i = 0; i < morph.vertices.size(); ++i) {
        out.normals[morph.vertices[i]] += weight * morph.normals[i];
    }
}

// One matrix for each vertex: that of its joints, or the only one.
template <typename MatrixOf>
void move_all(MatrixOf matrix_of, PosedVertices& out) noexcept {
    const bool has_normals = !out.normals.empty();
    for (std::size_t i = 0; i < out.positions.size(); ++i) {
        const Columns matrix = matrix_of(i);
        out.positions[i] = place(matrix, out.positions[i]);
        if (has_normals) {
            out.normals[i] = direction(matrix, out.normals[i]);
        }
    }
}

}  // namespace

std::size_t matrix_count(const Model& model, int node) noexcept {
    const int skin = model.nodes[static_cast<std::size_t>(node)].skin;
    return skin < 0 ? 1 : model.skins[static_cast<std::size_t>(skin)].joints.size();
}

void skinning_matrices(const Model& model,
                       const JointTree& tree,
                       const JointState& state,
                       int node,
                       std::span<glm::mat4> matrices) noexcept {
    const auto world = [&](int of) {
        const int joint = tree.joint_of(of);
        return joint < 0 ? glm::mat4(1.0F) : state.world[static_cast<std::size_t>(joint)];
    };
    const int skin_index = model.nodes[static_cast<std::size_t>(node)].skin;
    if (skin_index < 0) {
        matrices[0] = world(node);
        return;
    }
    const ModelSkin& skin = model.skins[static_cast<std::size_t>(skin_index)];
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        matrices[i] = world(skin.joints[i]) * skin.inverse_bind[i];
    }
}

void pose_vertices(const ModelPrimitive& primitive,
                   std::span<const float> morph_weights,
                   std::span<const glm::mat4> matrices,
                   PosedVertices& out) {
    out.positions.assign(primitive.positions.begin(), primitive.positions.end());
    out.normals.assign(primitive.normals.begin(), primitive.normals.end());
    const std::size_t targets = std::min(morph_weights.size(), primitive.morphs.size());
    for (std::size_t i = 0; i < targets; ++i) {
        if (morph_weights[i] != 0.0F) {
            add_morph(primitive.morphs[i], morph_weights[i], out);
        }
    }
    // A mesh with joints may hang from a node without a skin, too.
    if (primitive.joints.empty() || matrices.size() == 1) {
        const Columns only = blend(matrices, Joints{}, Weights{1.0F});
        move_all([&](std::size_t) { return only; }, out);
        return;
    }
    move_all(
        [&](std::size_t i) { return blend(matrices, primitive.joints[i], primitive.weights[i]); },
        out);
}

}  // namespace raks::render
