#pragma once

#include "render/mannequin/body_field.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// How open the skin is at `p` with normal `normal`: 1 on a free ball, 0.12 at least. From the
/// field in the bind pose, so it costs nothing per picture. Threads: any.
[[nodiscard]] float ambient_occlusion(const BodyField& field,
                                      glm::vec3 p,
                                      glm::vec3 normal) noexcept;

}  // namespace raks::render
