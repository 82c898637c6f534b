// For the sources of this folder: a board as OpenCV wants it.
#pragma once

#include <opencv2/aruco/charuco.hpp>

#include "motion/capture/calibration/board.hpp"

namespace raks::capture {

/// The same ChArUco board of OpenCV. `board` passed check_board.
[[nodiscard]] cv::Ptr<cv::aruco::CharucoBoard> charuco_board(const Board& board);

}  // namespace raks::capture
