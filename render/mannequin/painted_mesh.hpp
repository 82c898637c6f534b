// Collects what the mannequin wears over its skin: points with a colour of the theme.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/model/model.hpp"
#include "render/model/paint.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// One vertex in the T-pose.
struct PaintedPoint {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    Paint paint = Paint::skin;
    glm::vec3 tint{1.0F};  ///< times the paint
    float open = 1.0F;     ///< ambient occlusion, 1 = open
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{1.0F, 0.0F, 0.0F, 0.0F};
};

/// A primitive that grows point by point and sheet by sheet.
class PaintedMesh {
 public:
    /// Returns its number.
    std::uint32_t add(const PaintedPoint& point);
    /// Triangles of a grid of `rows` x `columns` points, numbered row by row from `first`;
    /// counter-clockwise when rows run down and columns to the right as seen from outside.
    /// `is_turned`: the other way round. `is_ring`: the last column joins the first.
    struct Grid {
        std::uint32_t first = 0;
        std::uint32_t rows = 0;
        std::uint32_t columns = 0;
        bool is_turned = false;
        bool is_ring = false;
    };
    void connect(const Grid& grid);
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool is_turned);

    [[nodiscard]] std::uint32_t size() const noexcept {
        return static_cast<std::uint32_t>(primitive_.positions.size());
    }
    [[nodiscard]] const ModelPrimitive& primitive() const noexcept { return primitive_; }

    /// The primitive of a material; nothing is left here.
    [[nodiscard]] ModelPrimitive take(int material);

 private:
    ModelPrimitive primitive_;
};

}  // namespace raks::render
