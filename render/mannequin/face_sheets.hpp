// The sheets of which a face is made: eyes, lids, lashes, brows and mouth, flat, as seen from the
// front. Lengths in metres, x to the figure's left, y from the floor.
#pragma once

#include <cstdint>
#include <vector>

#include "render/mannequin/face_shape.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/mannequin/painted_mesh.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

inline constexpr float kEyeHeight = 1.5915F;  ///< y of the eyes' middles

/// A point of a sheet: a place of the face seen from the front, and how far off the skin.
struct FacePoint {
    float x = 0.0F;
    float y = 0.0F;
    float off = 0.0F;
    Paint paint = Paint::skin;
    glm::vec3 tint{1.0F};
};

/// Rows of points; each sheet is drawn on the left side and mirrored, or once across the middle.
struct Sheet {
    std::uint32_t rows = 0;
    std::uint32_t columns = 0;
    std::vector<FacePoint> points;
    bool is_disc = false;  ///< rings about a middle that is its first row
    bool is_right = false;
};

/// All sheets of a shape: the same numbers of points in the same order for every shape.
[[nodiscard]] std::vector<Sheet> face_sheets(const FaceShape& shape, MannequinBuild build);

}  // namespace raks::render
