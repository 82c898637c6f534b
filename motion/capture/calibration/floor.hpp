// The world's floor and up, from the board lying on the floor.
#pragma once

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_pose.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture {

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
