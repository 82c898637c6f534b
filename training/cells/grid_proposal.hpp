#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "training/cells/grid_cues.hpp"
#include "training/cells/take_grid.hpp"

/// Grid proposal: a grid of beats from the motion of a take alone, to be set right by a person. Of
/// 17 stretches whose repeats are known it is right within 4 % in 8, by chance it would be in 2:
/// errors are most often 3:4 and 2:3.
namespace raks::motion {

/// Motion that comes back after a while.
struct FoundLag {
    double start = 0.0;     ///< seconds of the clip
    double end = 0.0;       ///< where the second one ends
    double seconds = 0.0;   ///< from one to the other
    double distance = 0.0;  ///< between them, over that of two random moments nearby; 0: the same
};

/// A grid and what it was made from.
struct GridProposal {
    TakeGrid grid;               ///< over all of the clip; idle stretches are not used
    std::vector<double> tempi;   ///< BPM by second, as the path has them
    std::vector<FoundLag> lags;  ///< repeats, rising, those that are closest
    double idle_seconds = 0.0;   ///< of the clip

    /// The median tempo of the beats that are used, BPM; 0 where there are none.
    [[nodiscard]] double tempo() const;
};

/// Proposes a grid: a tempo that may drift, from the periods of the cues in windows of 8 s and from
/// how alike four or eight beats are to those before them (Viterbi), then the beats that meet most
/// of the cues at that tempo (Ellis 2007), halves by which every other beat has more of them. Beats
/// lie 0.36 to 0.75 s apart on the whole: 80 to 166 BPM; what is faster is counted at half its
/// tempo. A clip under two seconds, or without motion, has no beats. Deterministic. Threads:
/// workers. Real-time: no.
[[nodiscard]] GridProposal propose_grid(const std::string& take, const GridCues& cues);

}  // namespace raks::motion
