// A model in numbers: what is in it, and how it stands as its nodes are stored.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "render/model/model.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace raks::render {

/// Where all nodes are in the pose that the file stores: world from node, in the file's metres.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<glm::mat4> rest_world(const Model& model);

/// A box along the axes.
struct ModelBox {
    glm::vec3 low{0.0F};
    glm::vec3 high{0.0F};
};

/// Box around all triangles of the scene in the rest pose, skins applied; none: there are none.
/// Threads: any. Real-time: no.
[[nodiscard]] std::optional<ModelBox> rest_box(const Model& model);

/// Triangles of one material in the mesh of a node of the scene.
struct RestPart {
    int node = -1;
    std::size_t primitive = 0;    ///< of the node's mesh
    std::optional<ModelBox> box;  ///< at rest, skins applied; none: it has no triangles
};

/// All of them, by the tree's order. Threads: any. Real-time: no.
[[nodiscard]] std::vector<RestPart> rest_parts(const Model& model);

/// Counts are those of the file.
struct ModelSurvey {
    std::string format;  ///< "VRM 0.x", "VRM 1.0", "VRMA 1.0", "glTF 2.0", "3DS v3"
    std::size_t nodes = 0;
    std::size_t joints = 0;  ///< of all skins, each once
    std::size_t skins = 0;
    std::size_t meshes = 0;
    std::size_t primitives = 0;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t max_morphs = 0;
    std::size_t images = 0;
    std::size_t animations = 0;
    std::size_t humanoid_bones = 0;
    std::size_t springs = 0;  ///< chains, or VRM 0.x's bone groups
    std::size_t spring_chains = 0;
    std::size_t expressions = 0;
    /// The farthest that a joint's place differs between the rest and the bind pose, metres of the
    /// file; none: no skin says its bind pose.
    std::optional<float> rest_minus_bind;
    std::optional<ModelBox> box;
    /// Where the figure looks in the rest pose, and where its left foot points: "+Z", and the
    /// cosine where it is far from the axis: "-X(0.76)". Empty: not known.
    std::string facing;
    std::optional<double> facing_degrees;  ///< the same about y: 0 is +z, +90 is +x
    std::string toe_direction;
};

/// Counts and measures. Threads: any. Real-time: no.
[[nodiscard]] ModelSurvey survey(const Model& model);

}  // namespace raks::render
