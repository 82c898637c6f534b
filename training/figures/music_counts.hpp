#pragma once

#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/label_tables.hpp"

/// Counts of a dance from the music that was danced to (Ofli 2008, sections 2 and 4.1): labels then
/// need only start and end.
namespace raks::motion {

/// A beat as tracked.
struct MusicBeat {
    double seconds = 0.0;  ///< of the music
    int bar_position = 0;  ///< from 1; 0: not known
};

struct DancedMusic {
    std::string name;              ///< for errors
    double duration = 0.0;         ///< seconds
    std::vector<MusicBeat> beats;  ///< rising
    /// Seconds of the music at every clip's first frame; negative when clips begin earlier.
    double offset = 0.0;
};

/// Frames of one label's counts, or why it cannot be learnt from.
struct LabelCounts {
    std::vector<double> frames;  ///< one a beat, the end included, rising
    std::string left_out;        ///< empty: fine
};

/// The tracked beats from the one nearest to the label's start to the one nearest to its end; of
/// two about as near to the start, that on bar position 1. A beat that the tracker missed is filled
/// in; when it heard half or twice as many as the label says (an octave), beats are split or left
/// out. A label without a number of beats has those that were heard.
/// Errors: a label before or behind the music, or with no beats in it.
[[nodiscard]] Expected<LabelCounts> counts_of(const FigureLabel& label,
                                              const DancedMusic& music,
                                              double frames_per_second);

}  // namespace raks::motion
