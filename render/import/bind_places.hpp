// Where the nodes of a model are as its skin was bound.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// World from each node as the skins were bound, which is a standing pose, where the transforms as
/// stored (rest_world) may be a frame of an animation: joints by their inverse bind matrices, what
/// hangs on them as stored against them, all else as stored. The space of the mesh, in which those
/// matrices are, may have any unit, axes and place: it is brought into the world by the root joint
/// of the skin, which stays where it is stored, but for the pose that it may be in. Skins without
/// such matrices, or with ones that cannot be inverted, are as stored; so are joints that only such
/// skins have as were bound in another pose than the largest.
[[nodiscard]] std::vector<glm::mat4> bind_world(const Model& model);

/// Calls `see(the node that moves it most, its place)` for each vertex that is shown, with the
/// nodes at `world`.
void for_each_vertex(const Model& model,
                     std::span<const glm::mat4> world,
                     const std::function<void(int, const glm::vec3&)>& see);

/// Origins of nodes.
[[nodiscard]] std::vector<glm::vec3> places_of(std::span<const glm::mat4> world);

/// Lowest and highest corner of all vertices, skins applied, with the nodes at `world`; both 0
/// where there are none.
struct MeshBox {
    glm::vec3 lowest{0.0F};
    glm::vec3 highest{0.0F};
};
[[nodiscard]] MeshBox mesh_box(const Model& model, std::span<const glm::mat4> world);

/// The node that moves a vertex of a primitive most, which `node` shows: a joint of its skin, or
/// the node itself.
[[nodiscard]] int mover_of(const Model& model,
                           const ModelPrimitive& primitive,
                           std::size_t vertex,
                           int node);

/// Mean over each node's vertices (those that it moves most) of their place against the node's
/// origin, in the world's axes; 0 where it has none.
[[nodiscard]] std::vector<glm::vec3> mean_offsets(const Model& model,
                                                  std::span<const glm::mat4> world);

/// Where each node's vertices reach from its origin, in the world's axes: along what they have
/// longest, as the joint may lie beside a limb, to the end that is farther from the joint. The mean
/// offset where they are about as broad as long, or reach as far both ways. As long as the mean
/// offset; 0 where it has none.
[[nodiscard]] std::vector<glm::vec3> flesh_directions(const Model& model,
                                                      std::span<const glm::mat4> world);

}  // namespace raks::render
