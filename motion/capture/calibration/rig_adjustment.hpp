// The adjustment of a whole rig to all that its cameras saw of a rigid board.
#pragma once

#include <cstdint>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/rig_start.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture {

/// What of the lenses is adjusted.
enum class LensFreedom : std::uint8_t {
    fixed,  ///< nothing
    five,   ///< the camera matrix, k1 k2 p1 p2 k3
    eight   ///< and k4 k5 k6
};

/// What became of it.
struct Adjustment {
    int rounds = 0;                  ///< of Levenberg's and Marquardt's
    double rms = 0.0;                ///< reprojection over all corners; pixels
    std::vector<double> camera_rms;  ///< by camera; 0 of one that saw nothing; pixels
};

/// Moves cameras, lenses and boards until what the cameras saw is explained best: least squares of
/// the reprojection with a soft L1 loss at 1 px. The board stays rigid and of its size, which is
/// all that keeps the rig's: with free points and free lenses it drifts while the reprojection
/// falls. The first camera stays where it is. Sightings of moments without a place are passed over.
/// The same input gives the same bits. Error: the least squares find no finite solution.
/// Threads: any; it uses one. Real-time: no (seconds).
[[nodiscard]] Expected<Adjustment> adjust_rig(Rig& rig,
                                              BoardPlaces& places,
                                              const Board& board,
                                              const std::vector<Sighting>& sightings,
                                              LensFreedom freedom = LensFreedom::five);

}  // namespace raks::capture
