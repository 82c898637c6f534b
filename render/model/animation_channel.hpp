// Animation channel: the value of what a clip of a model moves, at any time.
#pragma once

#include "render/model/model.hpp"

#include <glm/vec4.hpp>

namespace raks::render {

/// Value of a channel at a time: 3 numbers (translation, scale), 4 (rotation, x y z w, unit), the
/// first 4 of weights. Threads: any. Real-time: yes.
[[nodiscard]] glm::vec4 sample_channel(const AnimationChannel& channel, float seconds) noexcept;

}  // namespace raks::render
