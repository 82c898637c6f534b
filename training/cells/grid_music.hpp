#pragma once

#include <string>

#include "training/cells/grid_cues.hpp"
#include "training/cells/take_grid.hpp"
#include "training/figures/label_counts.hpp"

/// Grid music: the beats of the song that a take was danced to, laid over it.
namespace raks::motion {

/// Where a song lies against a take.
struct MusicOffset {
    double seconds = 0.0;  ///< of the music at the clip's first frame
    /// How much more of the cues its beats meet than those of a chance offset do, in deviations of
    /// all offsets: below 3 it is hardly more than chance.
    double strength = 0.0;
};

/// Finds the offset by which the music's beats meet most of the cues: landings, braking, hips. A
/// song of a steady tempo meets as many a beat earlier or later: of offsets that are about as good
/// the one nearest to 0 wins, so that a bar is a guess. Threads: workers. Real-time: no.
[[nodiscard]] MusicOffset find_offset(const GridCues& cues, const DancedMusic& music);

/// The music's beats within the clip as a grid. Beats 1 and 3 of its bars are those of the first
/// half; where the place in the bar is not known, every other one is. Beats of idle stretches are
/// not used.
[[nodiscard]] TakeGrid grid_of_music(const std::string& take,
                                     const GridCues& cues,
                                     const DancedMusic& music);

}  // namespace raks::motion
