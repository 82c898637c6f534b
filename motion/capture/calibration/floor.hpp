// The world's floor and up, from the board lying on the floor.
#pragma once

#include <string>

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_pose.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture {

/// A line that says how large a square of the board is in each camera's picture where it lies in
/// the middle of what the cameras look at, and how large one must be to be found. The lowest camera
/// is taken to stand 1.4 m above the floor, which the rig does not know yet; its y is up.
[[nodiscard]] std::string lying_board_size(const Rig& rig, const Board& board);

/// Moves a rig so that the floor is y = 0, up is y, and the middle of the board on the floor is the
/// origin, its rows along x. `seen`: what the cameras saw of the board while it lay there, printed
/// side up or down. A flat board has two poses that explain nearly the same, of which one puts
/// cameras under the floor: each pose that a camera proposes is fitted to what all cameras saw, and
/// of those with every camera above the floor the one is taken that explains it best. Errors: no
/// camera saw the board; no such pose.
[[nodiscard]] Expected<void> put_on_floor(Rig& rig,
                                          const Board& board,
                                          const std::vector<Sighting>& seen);

}  // namespace raks::capture
