// Pictures of a board that is carried before cameras of which all is known.
#pragma once

#include <filesystem>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::test {

/// Two cameras of 640 x 480 pixels, "left" and "right", 1.6 m high, that look at the middle of a
/// room from 2.4 m, a right angle apart.
[[nodiscard]] capture::Rig two_cameras();

/// Writes folders `left` and `right` of numbered pictures into `folder`: at the first eleven
/// moments the board is held before both, at the last, number 11, it lies on the floor in the
/// middle.
void film_board(const capture::Rig& rig,
                const capture::Board& board,
                const std::filesystem::path& folder);

}  // namespace raks::test
