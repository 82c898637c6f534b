#include "render/sphere_painter.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <utility>

#include "render/scene/stage_shapes.hpp"

#include <glm/vec3.hpp>

namespace raks::render {
namespace {

/// The unit sphere in rows of a globe.
Shape<glm::vec3> globe() {
    constexpr std::uint16_t kRows = 12;
    constexpr std::uint16_t kColumns = 20;
    Shape<glm::vec3> shape;
    for (std::uint16_t row = 0; row <= kRows; ++row) {
        const float polar = std::numbers::pi_v<float> * static_cast<float>(row) / kRows;
        for (std::uint16_t column = 0; column <= kColumns; ++column) {
            const float turn =
                2.0F * std::numbers::pi_v<float> * static_cast<float>(column) / kColumns;
            shape.vertices.emplace_back(std::sin(polar) * std::sin(turn),
                                        std::cos(polar),
                                        std::sin(polar) * std::cos(turn));
        }
    }
    for (std::uint16_t row = 0; row < kRows; ++row) {
        for (std::uint16_t column = 0; column < kColumns; ++column) {
            const auto a = static_cast<std::uint16_t>(row * (kColumns + 1) + column);
            const auto below = static_cast<std::uint16_t>(a + kColumns + 1);
            const auto right = static_cast<std::uint16_t>(a + 1);
            const auto across = static_cast<std::uint16_t>(below + 1);
            shape.indices.insert(shape.indices.end(), {a, below, right, right, below, across});
        }
    }
    return shape;
}

gl::Mesh globe_mesh() {
    const Shape<glm::vec3> shape = globe();
    constexpr std::array<gl::Attribute, 1> kAttributes = {
        {{.location = 0, .components = 3, .type = GL_FLOAT}}};
    return {
        std::as_bytes(std::span(shape.vertices)), sizeof(glm::vec3), kAttributes, shape.indices};
}

}  // namespace

SpherePainter::SpherePainter(gl::Program program)
    : program_(std::move(program)), sphere_(globe_mesh()) {}

Expected<SpherePainter> SpherePainter::create() {
    static constexpr std::array<std::string_view, 2> kVertex = {"frame.glsl", "sphere.vert"};
    static constexpr std::array<std::string_view, 2> kFragment = {"frame.glsl", "sphere.frag"};
    Expected<gl::Program> program = gl::Program::build({"spheres", kVertex, kFragment, {}});
    if (!program) {
        return fail(std::move(program.error()));
    }
    return SpherePainter(std::move(*program));
}

void SpherePainter::draw(std::span<const LitSphere> spheres) const noexcept {
    program_.use();
    const GLint place = program_.uniform("place");
    const GLint paint = program_.uniform("paint");
    for (const LitSphere& sphere : spheres) {
        glUniform4f(place, sphere.centre.x, sphere.centre.y, sphere.centre.z, sphere.radius);
        glUniform3f(paint, sphere.colour.r, sphere.colour.g, sphere.colour.b);
        sphere_.draw();
    }
}

}  // namespace raks::render
