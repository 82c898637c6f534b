// Waist: where a spot of two touching discs is cut in two.
#pragma once

#include <optional>
#include <span>

#include <glm/vec2.hpp>

namespace raks::capture {

/// A line across a spot: pixels with dot(pixel, direction) < at lie on one side.
struct Waist {
    glm::dvec2 direction{};  ///< of length 1, along the spot
    double at = 0.0;         ///< pixels
};

/// The waist of a spot that is two discs side by side: it is longer than wide by sqrt(2), and about
/// its middle less than four fifths as wide as on both sides. A disc that moved while it was filmed
/// is long, too, but has none. Spots below 16 pixels have none. Threads: any.
[[nodiscard]] std::optional<Waist> waist_of(std::span<const glm::ivec2> pixels);

}  // namespace raks::capture
