// What a dancer wears, as the shaders take it.
#pragma once

#include <array>

#include "render/model/mannequin_style.hpp"
#include "render/scene/scene.hpp"

#include <glm/vec4.hpp>

namespace raks::render {

/// The uniform block of gl/shaders/dress.glsl. std140: vec4 alone. Linear colours in the order of
/// Paint (render/model/paint.hpp); of a stick figure the first three: middle, left,
/// right.
struct DressColours {
    std::array<glm::vec4, 10> colours{};
};

/// Colours of the outfit `number` (modulo those that the theme has) in a costume, or of the plain
/// mannequin or stick figure where the scene shows one. Pure.
[[nodiscard]] DressColours dress_colours(const Scene& scene,
                                         int number,
                                         MannequinStyle style = {}) noexcept;

}  // namespace raks::render
