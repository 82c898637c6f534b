#pragma once

#include <vector>

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Samples a second of what performances are played as.
inline constexpr int kPerformanceRate = 44'100;

/// One note as played, in seconds.
struct PlayedNote {
    double time = 0.0;
    double length = 0.1;
    int channel = kDrumChannel;
    int key = 36;
    int program = 0;
    int velocity = 90;
    double cents = 0.0;  ///< above the key; of all notes that its channel plays then
};

struct PlayedBeat {
    double time = 0.0;
    int bar_position = 1;
};

/// A score as people would play it.
struct Performance {
    std::vector<PlayedNote> notes;  ///< by time
    std::vector<PlayedBeat> beats;  ///< ascending
    double seconds = 0.0;
};

/// Plays a score from a random place on for about `seconds`: the tempo drawn in the style's range
/// (steady, drifting, rubato, a ramp or a step), each instrument a little early or late, jitter,
/// dropped and ghost notes, each instrument group at a volume of its own.
[[nodiscard]] Performance perform(const Score& score, double seconds, Dice& dice);

}  // namespace raks::audio
