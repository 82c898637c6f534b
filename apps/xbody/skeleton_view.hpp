// Skeleton view: bones and names, drawn over the picture of the model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/xbody/node_kinds.hpp"
#include "apps/xbody/shown_model.hpp"
#include "render/panes/pane_context.hpp"
#include "render/scene/camera.hpp"

#include <glm/vec2.hpp>

namespace raks::apps {

/// A node of the skeleton as it is seen.
struct SeenNode {
    int node = -1;
    int parent = -1;                ///< node from which its line comes; -1: it has none
    glm::vec2 at{};                 ///< in the frame; units
    std::optional<glm::vec2> from;  ///< where its line comes from; none: it has none
    NodeKind kind = NodeKind::helper;
    std::string name;        ///< of the bone, else of the node
    bool is_needed = false;  ///< a bone without which no figure dances
};

/// The skeleton of a model in a box of the frame, seen by a camera. What lies behind it is left
/// out. `humanoid`: the bones, which labels may have changed. `is_hidden`, by node: left out; may
/// be empty.
[[nodiscard]] std::vector<SeenNode> seen_skeleton(const ShownModel& model,
                                                  const ShownPose& shown,
                                                  const render::HumanoidMap& humanoid,
                                                  const std::vector<bool>& is_hidden,
                                                  const render::Camera& camera,
                                                  const render::Box& box);

/// Colour of a kind of node, in the tree and in the view.
[[nodiscard]] render::Colour colour_of(NodeKind kind) noexcept;

/// How a skeleton is drawn.
struct SkeletonLook {
    bool has_names = false;
    int chosen = -1;   ///< node, drawn larger, its name always; -1: none
    int pointed = -1;  ///< node under the pointer, its name always; -1: none
};
/// Of each node whether its name is drawn: with names those of the chosen node and of the nodes
/// next to it; where none is chosen those of the bones that a figure needs; without such bones all.
/// Fifty names, half of them of fingers, would cover one another.
[[nodiscard]] std::vector<bool> named_nodes(const std::vector<SeenNode>& nodes,
                                            const SkeletonLook& look);
/// The nearest node within reach of a place, units; null: none.
[[nodiscard]] const SeenNode* node_near(const std::vector<SeenNode>& nodes, const glm::vec2& place);
/// Draws it.
void draw_skeleton(const render::PaneFrame& frame,
                   const std::vector<SeenNode>& nodes,
                   const SkeletonLook& look);

}  // namespace raks::apps
