// Node kinds: what each node of a model is there for.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "render/model/model.hpp"

namespace raks::apps {

/// What a node is; the first of these that it is.
enum class NodeKind : std::uint8_t {
    bone,      ///< of the figure
    spring,    ///< swings
    mesh,      ///< has triangles that a skin moves
    part,      ///< has triangles that move with it: a rigid part
    collider,  ///< carries what springs do not pass
    helper,    ///< all others
};

/// "bone", "rigid part".
[[nodiscard]] std::string_view words_of(NodeKind kind) noexcept;

/// The kind of each node. `humanoid`: the bones of the figure, those of the file or others.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<NodeKind> node_kinds(const render::Model& model,
                                               const render::HumanoidMap& humanoid);

/// What is drawn of the skeleton: for each node the node from which its line comes, its nearest
/// ancestor that is drawn, too.
struct SkeletonNode {
    int node = -1;
    int parent = -1;  ///< -1: it is the first of its tree
};

/// Bones of the figure and joints of skins, and of a model without skins its rigid parts.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<SkeletonNode> skeleton_nodes(const render::Model& model,
                                                       const render::HumanoidMap& humanoid);

}  // namespace raks::apps
