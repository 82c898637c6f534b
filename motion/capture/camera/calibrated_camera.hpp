// Camera: how a world point becomes a pixel, and what a pixel says of the world.
#pragma once

#include <array>
#include <optional>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// Capture: a dance from several films. World axes are those of all Raks: right-handed, metres, y
/// up, the floor at y = 0. A camera's own axes are OpenCV's: x to the right, y down, z forward. A
/// pixel's whole numbers are its centre; (0, 0) is the top left one. All of it is for tools: double
/// precision, may allocate. Threads: any. Real-time: no.
namespace raks::capture {

/// A lens with its picture: the camera matrix and the distortion of OpenCV.
struct Lens {
    int width = 0;    ///< of the picture; pixels
    int height = 0;   ///< of the picture; pixels
    double fx = 0.0;  ///< focal length, pixels; > 0
    double fy = 0.0;  ///< likewise
    double cx = 0.0;  ///< principal point, pixels
    double cy = 0.0;  ///< likewise
    /// k1 k2 p1 p2 k3 k4 k5 k6, in the order of OpenCV: radial, tangential, radial, and the three
    /// of the denominator.
    std::array<double, 8> distortion{};

    friend bool operator==(const Lens&, const Lens&) = default;
};

/// A camera that stands somewhere: place = rotation * world + translation.
struct Camera {
    std::string name;
    Lens lens;
    glm::dmat3 rotation{1.0};  ///< camera from world
    glm::dvec3 translation{};  ///< camera from world; metres

    /// Where it stands in the world.
    [[nodiscard]] glm::dvec3 centre() const noexcept;
    /// A world point in the camera's own axes.
    [[nodiscard]] glm::dvec3 in_camera(const glm::dvec3& world) const noexcept {
        return rotation * world + translation;
    }

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// The camera at `centre` that looks at `target`, its picture upright; both metres, not the same
/// place, and not one above the other.
[[nodiscard]] Camera looking_at(std::string name,
                                const Lens& lens,
                                const glm::dvec3& centre,
                                const glm::dvec3& target);

/// A direction (x / z, y / z) as its pixel, with the lens' distortion.
[[nodiscard]] glm::dvec2 distorted_pixel(const Lens& lens, const glm::dvec2& direction) noexcept;

/// A pixel as a direction (x / z, y / z), without the lens' distortion: ten fixed-point steps, then
/// Newton's, until the pixel is met within 1e-6. Where a lens folds over (distortion that is not
/// monotonic there) the nearest found is given.
[[nodiscard]] glm::dvec2 direction_of(const Lens& lens, const glm::dvec2& pixel) noexcept;

/// How far from the principal point the distortion grows with the angle, so that each pixel has
/// one direction; pixels of the mean focal length. Infinite: in the whole picture. Beyond it the
/// lens folds over.
[[nodiscard]] double folding_radius(const Lens& lens) noexcept;

/// The pixel of a world point, which may lie outside of the picture. None: it is behind the camera.
[[nodiscard]] std::optional<glm::dvec2> project(const Camera& camera, const glm::dvec3& world);

/// Whether a pixel lies in the picture.
[[nodiscard]] bool is_in_picture(const Lens& lens, const glm::dvec2& pixel) noexcept;

/// The fundamental matrix F between directions of two cameras (then often called the essential
/// matrix): b^T F a = 0 for directions a of `from` and b of `to` (with 1 as third) of one point.
[[nodiscard]] glm::dmat3 epipolar_matrix(const Camera& from, const Camera& to) noexcept;

/// Distance of a direction in `to` from the epipolar line of a direction in `from`, in pixels of
/// `to` (its mean focal length).
[[nodiscard]] double epipolar_distance(const Camera& from,
                                       const glm::dvec2& from_direction,
                                       const Camera& to,
                                       const glm::dvec2& to_direction) noexcept;

}  // namespace raks::capture
