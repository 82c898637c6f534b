// Label counts: the frames of a label's counts, from a table or from the beats of the music.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/label_tables.hpp"

namespace raks::motion {

/// Frames of all beats of a label, the end included, from a table of counts. A count that the table
/// lacks (where the phase breaks) is interpolated between its neighbours; the label's start and end
/// stand in for a missing first or last count. Size: label.beats + 1.
[[nodiscard]] std::vector<double> beat_frames_of(const FigureLabel& label,
                                                 std::span<const CountTime> counts);

// Takes the counts of a dance from the tracked beats of its music (Ofli 2008, sections 2 and 4.1),
// so that labels need to give only start and end.

/// A beat as tracked.
struct MusicBeat {
    double seconds = 0.0;  ///< of the music
    int bar_position = 0;  ///< from 1; 0: not known
};

/// The tracked music of a recording.
struct DancedMusic {
    std::string name;              ///< shown in error messages
    double duration = 0.0;         ///< seconds
    std::vector<MusicBeat> beats;  ///< rising
    /// Seconds of the music at every clip's first frame; negative when clips begin earlier.
    double offset = 0.0;
};

/// Frames of one label's counts, or the reason why it is left out of training.
struct LabelCounts {
    std::vector<double> frames;  ///< one a beat, the end included, rising
    std::string left_out;        ///< the reason; empty: it is used
};

/// The tracked beats from the one nearest to the label's start to the one nearest to its end. Where
/// two beats are about equally near to the start, the one on bar position 1 wins. A missed beat is
/// interpolated. Where the tracker found half or twice as many beats as the label gives (an
/// octave), beats are inserted or dropped. A label without a number of beats gets the tracked
/// number.
/// Errors: a label before or behind the music, or with no beats in it. Threads: any. Real-time: no.
[[nodiscard]] Expected<LabelCounts> counts_of(const FigureLabel& label,
                                              const DancedMusic& music,
                                              double frames_per_second);

}  // namespace raks::motion
