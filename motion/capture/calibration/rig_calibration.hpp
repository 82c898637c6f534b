// The calibration of a rig, from what its cameras saw of a board to a report.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/edge_errors.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture {

/// A camera that is to be calibrated.
struct FilmedCamera {
    std::string name;
    int width = 0;   ///< of its pictures; pixels
    int height = 0;  ///< likewise
    /// What it saw of the board when no other camera counts: for its lens alone.
    std::vector<std::vector<BoardCorner>> lens_views;
};

/// How to calibrate.
struct CalibrationSettings {
    int coefficients = 5;  ///< of the distortion: 5, or 8 for wide lenses
    /// Each so many-th moment that two or more cameras share is held out, to be measured by; at
    /// least 2.
    std::size_t held_out_every = 5;
    /// Where the board lay on the floor. None, or no camera saw it there: the floor stays unknown,
    /// and the doubts say so.
    std::optional<std::size_t> floor_moment;
};

/// What there is to say of a camera.
struct CameraReport {
    std::size_t views = 0;  ///< of the board, those for the lens alone included
    double lens_rms = 0.0;  ///< reprojection of its lens alone; pixels
    double rms = 0.0;       ///< reprojection in the rig; pixels
};

/// A calibrated rig.
struct RigCalibration {
    /// Metres. With a floor: y up from it, the board's middle as origin. Without: the axes of the
    /// first camera, turned so that the cameras' mean up is y, and moved so that the lowest camera
    /// is at y = 1.
    Rig rig;
    std::vector<CameraReport> cameras;  ///< in the rig's order
    SharedViews shared;                 ///< moments, held out ones not counted
    EdgeErrors held_out;                ///< of boards that the rig was not calibrated with
    EdgeErrors used;                    ///< of those that it was
    double rms = 0.0;                   ///< reprojection over all corners used; pixels
    bool has_floor = false;
    std::vector<std::string> doubts;  ///< one line each
};

/// Calibrates: the lens of each camera, the cameras by shared views, then all together with rigid
/// boards; then the floor. `sightings`: what was seen at once has the same moment. Errors, one line
/// that says what to film: fewer than two cameras; a camera that saw no board, or too few or too
/// similar ones; cameras that shared views do not join.
/// The same input gives the same bits. Threads: any; it uses one. Real-time: no (seconds).
[[nodiscard]] Expected<RigCalibration> calibrate_rig(const Board& board,
                                                     const std::vector<FilmedCamera>& cameras,
                                                     const std::vector<Sighting>& sightings,
                                                     const CalibrationSettings& settings = {});

}  // namespace raks::capture
