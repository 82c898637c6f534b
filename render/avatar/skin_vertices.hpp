// Vertices of a posed model, computed without a graphics card: for soles, girth and .obj files.
#pragma once

#include <span>
#include <vector>

#include "render/avatar/joint_tree.hpp"
#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// Vertices of one primitive in the avatar's space.
struct PosedVertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< not of length 1; empty where the model has none
};

/// Number of matrices that move the mesh of a node: the joints of its skin, else 1.
[[nodiscard]] std::size_t matrix_count(const Model& model, int node) noexcept;

/// The matrices that move the mesh of a node, avatar's space from the mesh's: by joint of its skin,
/// else the node's own. `matrices` holds `matrix_count`. Threads: any. Real-time: yes.
void skinning_matrices(const Model& model,
                       const JointTree& tree,
                       const JointState& state,
                       int node,
                       std::span<glm::mat4> matrices) noexcept;

/// Moves the vertices of a primitive by its morph targets (weights by target; too few: the others
/// are 0) and by linear blend skinning; where there is one matrix alone, or the primitive has no
/// joints, it goes with the first matrix.
/// `out` is made as long as the primitive; it grows at the first use alone. Threads: one caller an
/// `out`. Real-time: yes, when `out` was used for a primitive as long.
void pose_vertices(const ModelPrimitive& primitive,
                   std::span<const float> morph_weights,
                   std::span<const glm::mat4> matrices,
                   PosedVertices& out);

}  // namespace raks::render
