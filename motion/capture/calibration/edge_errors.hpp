// How long a rig sees the edges of a board: what tells whether it can be trusted.
#pragma once

#include <vector>

#include "motion/capture/calibration/board.hpp"
#include "motion/capture/calibration/view_graph.hpp"
#include "motion/capture/camera/rig.hpp"

namespace raks::capture {

/// Errors of the lengths of a board's edges, from corners that two or more cameras saw.
struct EdgeErrors {
    std::size_t points = 0;     ///< corners that were triangulated
    std::size_t edges = 0;      ///< between them; without any the other values are 0
    double mean = 0.0;          ///< of the absolute errors; metres
    double rms = 0.0;           ///< metres
    double bias = 0.0;          ///< mean of the errors, long is positive; metres
    double worst = 0.0;         ///< the largest; metres
    double reprojection = 0.0;  ///< mean distance of the corners from where they were seen; pixels
};

/// Triangulates every corner by the direct linear solution and compares the edges between
/// neighbours of one moment with the squares' side. Of boards that were held out of the calibration
/// this is an honest figure; the reprojection is none (it falls while a rig drifts).
[[nodiscard]] EdgeErrors edge_errors(const Rig& rig,
                                     const Board& board,
                                     const std::vector<Sighting>& sightings);

}  // namespace raks::capture
