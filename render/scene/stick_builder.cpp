#include "render/scene/stick_builder.hpp"

#include <cmath>
#include <glm/ext/scalar_constants.hpp>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <utility>

namespace raks::render {
namespace {

// Metres, from the head's joint at the top of the neck.
constexpr glm::vec3 kHeadRadii{0.073F, 0.099F, 0.088F};
constexpr glm::vec3 kHeadMiddle{0.0F, 0.095F, 0.012F};
constexpr float kNoseRadius = 0.014F;

float ratio(std::size_t i, std::size_t count) noexcept {
    return static_cast<float>(i) / static_cast<float>(count);
}

}  // namespace

/// A part of the middle has neither side's colour.
void StickBuilder::set_tint(float tint) noexcept {
    const auto share = static_cast<std::uint8_t>(std::lround(255.0F * tint));
    left_ = part_ == StickPart::left ? share : std::uint8_t{0};
    right_ = part_ == StickPart::right ? share : std::uint8_t{0};
}

void StickBuilder::add_ellipsoid(glm::vec3 middle,
                                 glm::vec3 radii,
                                 std::size_t rows,
                                 std::size_t columns) {
    const std::size_t first = shape_.vertices.size();
    for (std::size_t row = 0; row <= rows; ++row) {
        const float polar = glm::pi<float>() * ratio(row, rows);
        for (std::size_t column = 0; column <= columns; ++column) {
            const float around = 2.0F * glm::pi<float>() * ratio(column, columns);
            const glm::vec3 unit{std::sin(polar) * std::cos(around),
                                 std::cos(polar),
                                 -std::sin(polar) * std::sin(around)};
            // The normal of an ellipsoid is the unit sphere's, divided by the radii.
            add_vertex(middle + radii * unit, glm::normalize(unit / radii));
        }
    }
    connect(first, rows, columns);
}

void StickBuilder::add_cone(glm::vec3 from, glm::vec3 to, float from_radius, float to_radius) {
    constexpr std::size_t kSides = 12;
    const float length = glm::length(to - from);
    // Joints in one place have no axis between them.
    if (length < 1e-4F) {
        return;
    }
    const glm::vec3 axis = (to - from) / length;
    const glm::vec3 other =
        std::abs(axis.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 u = glm::normalize(glm::cross(axis, other));
    const glm::vec3 v = glm::cross(axis, u);
    // A taper tilts the normals toward the thin end.
    const float slope = (from_radius - to_radius) / length;
    const std::size_t first = shape_.vertices.size();
    // From the far ring to the near one: so that the triangles face outward.
    for (const auto& [centre, radius] : {std::pair{to, to_radius}, std::pair{from, from_radius}}) {
        for (std::size_t side = 0; side <= kSides; ++side) {
            const float angle = 2.0F * glm::pi<float>() * ratio(side, kSides);
            const glm::vec3 out = std::cos(angle) * u + std::sin(angle) * v;
            add_vertex(centre + radius * out, glm::normalize(out + slope * axis));
        }
    }
    connect(first, 1, kSides);
}

void StickBuilder::add_head() {
    add_ellipsoid(kHeadMiddle, kHeadRadii, 18, 28);
    const glm::vec3 nose = kHeadMiddle + glm::vec3(0.0F, -0.008F, kHeadRadii.z);
    add_ellipsoid(nose, glm::vec3(kNoseRadius), 8, 12);
}

void StickBuilder::add_vertex(glm::vec3 position, glm::vec3 normal) {
    shape_.vertices.push_back({.position = position,
                               .normal = normal,
                               .bone = bone_,
                               .left = left_,
                               .right = right_,
                               .occlusion = 230});
}

/// Two triangles for each cell of a grid whose rows have one point more than cells: the last column
/// repeats the first.
void StickBuilder::connect(std::size_t first, std::size_t rows, std::size_t columns) {
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t a = first + row * (columns + 1) + column;
            const std::size_t b = a + columns + 1;
            for (const std::size_t corner : {a, b, b + 1, a, b + 1, a + 1}) {
                shape_.indices.push_back(static_cast<std::uint16_t>(corner));
            }
        }
    }
}

}  // namespace raks::render
