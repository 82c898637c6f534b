#pragma once

#include <vector>

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Samples a second of what performances are played as.
inline constexpr int kPerformanceRate = 44'100;

/// One note as played, in seconds.
struct PlayedNote {
    double time = 0.0;           ///< onset, seconds from the start
    double length = 0.1;         ///< seconds
    int channel = kDrumChannel;  ///< MIDI's, 0 to 15
    int key = 36;                ///< MIDI's, 0 to 127
    int program = 0;             ///< General MIDI's, from 0; of drums: the kit
    int velocity = 90;           ///< 1 to 127
    double cents = 0.0;          ///< above the key; of all notes that its channel plays then
};

/// One beat as played: the annotation that training compares with.
struct PlayedBeat {
    double time = 0.0;     ///< seconds from the start
    int bar_position = 1;  ///< 1 is a downbeat
};

/// A score as people would play it.
struct Performance {
    std::vector<PlayedNote> notes;  ///< by time
    std::vector<PlayedBeat> beats;  ///< ascending
    double seconds = 0.0;           ///< length of the whole
};

/// Plays a score from a random beat on for about `seconds`: the tempo is drawn from the score's
/// range (steady, drifting, rubato, a ramp or a step), each instrument is a little early or late
/// and has a volume of its own, notes have jitter, some are dropped, some get a ghost note.
[[nodiscard]] Performance perform(const Score& score, double seconds, Dice& dice);

}  // namespace raks::audio
