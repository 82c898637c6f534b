#pragma once

#include <vector>

#include "base/dice.hpp"

namespace raks::audio {

inline constexpr int kDrumChannel = 9;  ///< General MIDI's, counted from 0

/// One note, in beats.
struct ScoreNote {
    double beat = 0.0;           ///< >= 0; beat 0 is the first of the score
    double length = 0.1;         ///< beats
    int channel = kDrumChannel;  ///< MIDI's, 0 to 15
    int key = 36;                ///< MIDI's; 60 is middle C; of drums: which one
    int program = 0;             ///< General MIDI's, from 0; of drums: the kit
    double velocity = 90.0;      ///< 1 to 127, rounded when played
    double cents = 0.0;          ///< above the key, -100 to 100: quarter tones
};

/// Music on paper: the beats are at 0, 1, 2, ...
struct Score {
    static constexpr int kNoBeat = -1;  ///< in `bar_position`: counted, but no beat of the music

    std::vector<ScoreNote> notes;   ///< in any order
    std::vector<int> bar_position;  ///< of each beat: 1 is a downbeat
    /// Into how many parts each beat is divided, 2 or 3; empty: as parts_of() says.
    std::vector<int> beat_parts;
    double bpm = 120.0;          ///< beats a minute, before a tempo curve bends it
    double lowest_bpm = 55.0;    ///< range in which the style is danced
    double highest_bpm = 217.0;  ///< as lowest_bpm
    bool has_drums = true;       ///< whether any note is a drum's
    bool is_expressive = false;  ///< no drums, free tempo: rubato fits
    bool is_programmed = false;  ///< machines play it: exact and mostly steady
    bool is_complete = false;    ///< no player is missing or pauses
};

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
    int parts = 2;         ///< into which the music divides the beat, 2 or 3
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
