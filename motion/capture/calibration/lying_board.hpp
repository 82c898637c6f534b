// Finding a board that lies on the floor: far away, and flat in the picture.
#pragma once

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_detection.hpp"

namespace raks::capture {

/// Finds a ChArUco board that is small and foreshortened: the picture is stretched until markers
/// are large and nearly square; those that are read say how the board lies, and so it is drawn from
/// above and looked at again. A picture is taken for the board only where its black and white agree
/// with the printed ones. What find_board finds is as good or better where the board is large. Of a
/// chessboard: as find_board. `board` passed check_board.
/// Threads: any. Real-time: no (half a second for 1280 x 720 pixels).
[[nodiscard]] BoardView find_lying_board(const GreyPicture& picture, const Board& board);

}  // namespace raks::capture
