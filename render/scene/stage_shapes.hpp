#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

/// Triangles of what never changes on the stage. Counter-clockwise seen from above or from the
/// viewer. Pure; called once at start.
namespace raks::render {

/// Vertices and triangles of one mesh.
template <typename Vertex>
struct Shape {
    /// At most 65,536: indices have 16 bits.
    std::vector<Vertex> vertices;
    std::vector<std::uint16_t> indices;  ///< three a triangle
};

/// Radius of the floor, metres: there it has faded into the backdrop.
inline constexpr float kFloorRadius = 4.6F;

/// The floor as rings of points (x, z), dense in the middle where shadows are: fine enough to carry
/// its colours per vertex.
[[nodiscard]] Shape<glm::vec2> floor_disc();

/// One beat ring for ring.vert: (cos, sin, offset from the line in half widths, brightness).
[[nodiscard]] Shape<glm::vec4> ring_strip();

/// One beam for beam.vert: across in [-1, 1], along in [0, 1].
[[nodiscard]] Shape<glm::vec2> beam_strip();

/// A grid over the picture in [-1, 1]^2, fine enough to carry the backdrop's colours per vertex.
[[nodiscard]] Shape<glm::vec2> backdrop_grid();

}  // namespace raks::render
