// A first guess of where cameras and boards stand, from one shared view to the next.
#pragma once

#include <map>
#include <vector>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/board_pose.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture {

/// Where the board stood at each moment: world from board.
using BoardPlaces = std::map<std::size_t, RigidMotion>;

/// Places cameras by the joins, the first one at the origin: of all relative poses that shared
/// views propose, for each join the one that explains the others best. Only rotation and
/// translation of `rig` are set; its lenses are taken as they are.
void place_cameras(Rig& rig,
                   const Board& board,
                   const std::vector<Sighting>& sightings,
                   const std::vector<Join>& joins);

/// Places the board at every moment: of the poses that single cameras propose the one that explains
/// best what all of them saw. Moments that propose none are left out.
[[nodiscard]] BoardPlaces place_boards(const Rig& rig,
                                       const Board& board,
                                       const std::vector<Sighting>& sightings);

}  // namespace raks::capture
