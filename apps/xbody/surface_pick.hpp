// Surface pick: which node is seen at a place of the picture.
#pragma once

#include <optional>
#include <vector>

#include "apps/xbody/shown_model.hpp"
#include "render/overlay/pen.hpp"
#include "render/scene/camera.hpp"

#include <glm/vec2.hpp>

namespace raks::apps {

/// The node whose surface a camera sees at a place of the frame, in the box that shows the model:
/// of a mesh with a skin the joint that moves the nearest corner of the triangle most, else the
/// node of the mesh. Faces are as morph targets at rest leave them. `is_hidden`, by node: its mesh
/// is not there; may be empty. None: nothing is seen there. Threads: one. Real-time: no (some
/// milliseconds for 100,000 vertices).
[[nodiscard]] std::optional<int> node_at(const glm::vec2& place,
                                         const ShownModel& model,
                                         const ShownPose& shown,
                                         const std::vector<bool>& is_hidden,
                                         const render::Camera& camera,
                                         const render::Box& box);

}  // namespace raks::apps
