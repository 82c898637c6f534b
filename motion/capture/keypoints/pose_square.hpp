// Pose square: the part of a picture in which a network looks for the joints of a person.
#pragma once

#include <glm/vec2.hpp>

namespace raks::capture {

/// A square in a picture, turned so that the person in it stands upright.
struct PoseSquare {
    glm::dvec2 centre{};  ///< pixels
    double side = 0.0;    ///< pixels; > 0
    double turn = 0.0;    ///< radians from the picture's x to the square's, towards y (clockwise)

    /// The place in the picture of a place in the square, whose corners are (0, 0) and (1, 1).
    [[nodiscard]] glm::dvec2 to_picture(const glm::dvec2& place) const noexcept;
    /// The reverse.
    [[nodiscard]] glm::dvec2 from_picture(const glm::dvec2& pixel) const noexcept;
};

/// The square about a person, by what BlazePose tells of it: the centre of the hips, and the point
/// of the circle around the whole body that lies in the direction of the head; 2.5 radii wide.
[[nodiscard]] PoseSquare pose_square(const glm::dvec2& hips, const glm::dvec2& on_circle) noexcept;

/// How much of two squares is common, by their upright bounds of the same centre and side: area of
/// what both have over that of what either has; [0, 1].
[[nodiscard]] double overlap_of(const PoseSquare& one, const PoseSquare& other) noexcept;

}  // namespace raks::capture
