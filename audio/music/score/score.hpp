#pragma once

#include <vector>

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
    std::vector<ScoreNote> notes;   ///< in any order
    std::vector<int> bar_position;  ///< of each beat: 1 is a downbeat
    double bpm = 120.0;             ///< beats a minute, before a tempo curve bends it
    double lowest_bpm = 55.0;       ///< range in which the style is danced
    double highest_bpm = 217.0;     ///< as lowest_bpm
    bool has_drums = true;          ///< whether any note is a drum's
    bool is_expressive = false;     ///< no drums, free tempo: rubato fits
    bool is_programmed = false;     ///< machines play it: exact and mostly steady
    bool is_complete = false;       ///< no player is missing or pauses
};

}  // namespace raks::audio
