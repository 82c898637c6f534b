// Where a board stands as one camera sees it.
#pragma once

#include <vector>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_detection.hpp"
#include "motion/capture/camera/calibrated_camera.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace raks::capture {

/// A rigid motion: place = rotation * point + translation; metres.
struct RigidMotion {
    glm::dmat3 rotation{1.0};
    glm::dvec3 translation{};

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& point) const noexcept {
        return rotation * point + translation;
    }
    /// First `before`, then this one.
    [[nodiscard]] RigidMotion after(const RigidMotion& before) const noexcept;
    [[nodiscard]] RigidMotion inverse() const noexcept;
};

/// How a camera stands: camera from world.
[[nodiscard]] RigidMotion pose_of(const Camera& camera) noexcept;
/// Puts it there.
void set_pose(Camera& camera, const RigidMotion& camera_from_world) noexcept;

/// A pose of a board that may explain what a camera saw.
struct BoardPose {
    RigidMotion camera_from_board;
    double rms = 0.0;  ///< reprojection, pixels
};

/// Both poses of a flat board that explain its corners, the better one first: seen from far they
/// are nearly mirror images of one another. Empty: fewer than four corners, or all on one line.
[[nodiscard]] std::vector<BoardPose> board_poses(const Lens& lens,
                                                 const Board& board,
                                                 const std::vector<BoardCorner>& corners);

/// Root mean square distance of the corners from where a board in that pose has them; pixels.
/// A corner behind the camera counts as 1000 px.
[[nodiscard]] double reprojection_rms(const Lens& lens,
                                      const Board& board,
                                      const RigidMotion& camera_from_board,
                                      const std::vector<BoardCorner>& corners);

}  // namespace raks::capture
