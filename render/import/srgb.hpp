// Colours of VRM 0.x are sRGB; all others of models are linear.
#pragma once

#include <cmath>

#include <glm/vec4.hpp>

namespace raks::render {

/// A part of a colour, 0 and above, from sRGB to linear (IEC 61966-2-1).
[[nodiscard]] inline float linear_from_srgb(float part) noexcept {
    return part <= 0.04045F ? part / 12.92F : std::pow((part + 0.055F) / 1.055F, 2.4F);
}

/// A colour; its alpha is linear already.
[[nodiscard]] inline glm::vec4 linear_from_srgb(const glm::vec4& colour) noexcept {
    return {linear_from_srgb(colour.x),
            linear_from_srgb(colour.y),
            linear_from_srgb(colour.z),
            colour.w};
}

}  // namespace raks::render
