#include "render/scene/stage_shapes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/ext/scalar_constants.hpp>
#include <initializer_list>

namespace raks::render {
namespace {

/// Two triangles for every cell of a grid of points, `columns` points a row. Row after row.
void connect_grid(std::vector<std::uint16_t>& indices, std::size_t rows, std::size_t columns) {
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const std::size_t a = row * columns + column;
            const std::size_t b = a + columns;
            for (const std::size_t corner : {a, a + 1, b + 1, a, b + 1, b}) {
                indices.push_back(static_cast<std::uint16_t>(corner));
            }
        }
    }
}

/// Number i of `count` equal steps from 0 to 1.
float share(std::size_t i, std::size_t count) noexcept {
    return static_cast<float>(i) / static_cast<float>(count);
}

/// Point i of `count` on the unit circle. Point `count` repeats point 0, so that a grid closes.
glm::vec2 on_circle(std::size_t i, std::size_t count) noexcept {
    const float angle = 2.0F * glm::pi<float>() * share(i, count);
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Shape<glm::vec2> floor_disc() {
    constexpr std::size_t kRings = 40;
    constexpr std::size_t kSpokes = 72;
    constexpr float kDensity = 1.6F;  // > 1: more rings near the middle
    Shape<glm::vec2> shape;
    for (std::size_t ring = 0; ring <= kRings; ++ring) {
        // Rings are crowded in the middle, where shadows and rings of light need fine triangles.
        const float radius = kFloorRadius * std::pow(share(ring, kRings), kDensity);
        for (std::size_t spoke = 0; spoke <= kSpokes; ++spoke) {
            shape.vertices.push_back(radius * on_circle(spoke, kSpokes));
        }
    }
    connect_grid(shape.indices, kRings + 1, kSpokes + 1);
    return shape;
}

Shape<glm::vec4> ring_strip() {
    constexpr std::size_t kSegments = 128;
    constexpr float kLine = 0.6F;   // half widths: full brightness up to here
    constexpr float kGlow = 1.5F;   // the line has become glow
    constexpr float kHalo = 4.0F;   // the glow is a third
    constexpr float kDark = 10.0F;  // the glow has ended
    // The cross-section of a ring: place in half widths of the line, brightness there.
    struct Profile {
        float offset;
        float brightness;
    };
    constexpr std::array<Profile, 8> kProfile = {{{-kDark, 0.0F},
                                                  {-kHalo, 0.33F},
                                                  {-kGlow, 1.0F},
                                                  {-kLine, 1.0F},
                                                  {kLine, 1.0F},
                                                  {kGlow, 1.0F},
                                                  {kHalo, 0.33F},
                                                  {kDark, 0.0F}}};
    Shape<glm::vec4> shape;
    for (const Profile& profile : kProfile) {
        for (std::size_t i = 0; i <= kSegments; ++i) {
            const glm::vec2 place = on_circle(i, kSegments);
            shape.vertices.emplace_back(place.x, place.y, profile.offset, profile.brightness);
        }
    }
    connect_grid(shape.indices, kProfile.size(), kSegments + 1);
    return shape;
}

Shape<glm::vec2> beam_strip() {
    constexpr std::size_t kAcross = 12;
    constexpr std::size_t kAlong = 8;
    Shape<glm::vec2> shape;
    for (std::size_t row = 0; row <= kAlong; ++row) {
        for (std::size_t column = 0; column <= kAcross; ++column) {
            shape.vertices.emplace_back(2.0F * share(column, kAcross) - 1.0F, share(row, kAlong));
        }
    }
    connect_grid(shape.indices, kAlong + 1, kAcross + 1);
    return shape;
}

Shape<glm::vec2> backdrop_grid() {
    constexpr std::size_t kColumns = 32;
    constexpr std::size_t kRows = 24;
    Shape<glm::vec2> shape;
    for (std::size_t row = 0; row <= kRows; ++row) {
        for (std::size_t column = 0; column <= kColumns; ++column) {
            shape.vertices.emplace_back(2.0F * share(column, kColumns) - 1.0F,
                                        2.0F * share(row, kRows) - 1.0F);
        }
    }
    connect_grid(shape.indices, kRows + 1, kColumns + 1);
    return shape;
}

}  // namespace raks::render
