// Spring view: what swings and what it does not pass, drawn over the picture of the model.
#pragma once

#include <vector>

#include "apps/xbody/shown_model.hpp"
#include "render/panes/pane_context.hpp"
#include "render/scene/camera.hpp"

#include <glm/vec2.hpp>

namespace raks::apps {

/// A circle or a line as it is seen; units.
struct SeenRing {
    glm::vec2 at{};
    float radius = 0.0F;
    bool is_collider = false;  ///< else the end of a link of a chain, as large as what hits there
};
struct SeenLine {
    glm::vec2 from{};
    glm::vec2 to{};
    bool is_collider = false;  ///< the side of a capsule; else a link of a chain
};

/// What is seen of springs.
struct SeenSprings {
    std::vector<SeenRing> rings;
    std::vector<SeenLine> lines;
};

/// Colliders and chains of a model in a box of the frame, seen by a camera. Planes are drawn as the
/// direction in which joints may be. What lies behind the camera is left out.
[[nodiscard]] SeenSprings seen_springs(const ShownModel& model,
                                       const ShownPose& shown,
                                       const render::Camera& camera,
                                       const render::Box& box);

/// Draws them.
void draw_springs(const render::PaneFrame& frame, const SeenSprings& springs);

}  // namespace raks::apps
