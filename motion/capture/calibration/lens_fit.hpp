// The lens of one camera, from pictures of a board.
#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_detection.hpp"
#include "motion/capture/camera/calibrated_camera.hpp"

namespace raks::capture {

/// How to fit a lens.
struct LensFitSettings {
    int coefficients = 5;            ///< of the distortion: 5, or 8 for wide lenses
    bool has_square_pixels = false;  ///< fx = fy
};

/// A lens and how well it explains the pictures.
struct LensFit {
    Lens lens;
    double rms = 0.0;                 ///< reprojection over all corners used; pixels
    std::vector<double> view_rms;     ///< of each view; 0 of those that were not used; pixels
    double focal_deviation = 0.0;     ///< standard deviation of fx, from the residuals; pixels
    std::vector<std::string> doubts;  ///< one line each, without the camera's name
};

/// Fits camera matrix and distortion to views of a board (Zhang's method with OpenCV's least
/// squares); views of fewer than 6 corners are not used. Errors, one line without the camera's
/// name: fewer than 3 views; all boards in one pose, or so alike that the focal length is known to
/// no better than 5 %. Doubts: fewer than 10 views, an RMS above 1 px.
/// Threads: any. Real-time: no (a second for 60 views).
[[nodiscard]] Expected<LensFit> fit_lens(int width,
                                         int height,
                                         const Board& board,
                                         const std::vector<std::vector<BoardCorner>>& views,
                                         const LensFitSettings& settings = {});

}  // namespace raks::capture
