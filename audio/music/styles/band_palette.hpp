#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raks::audio {

/// How likely each player of a band plays in a piece, [0, 1].
struct BandChances {
    double bass = 0.85;   ///< a bass line
    double chords = 0.8;  ///< an accompaniment
    double lead = 0.55;   ///< a melody of the band's own
};

/// The manner of a melody.
enum class Melody : std::uint8_t {
    riffs_ahead,      ///< riffs of one to three voices, mostly ahead of the beat, as brass plays
    maqam,            ///< one voice in a maqam that others follow a little late, over a drone
    sixteenth_riffs,  ///< riffs of sixteenths with wide leaps
    fifths,           ///< eighths and quarters over a guitar that plays roots and fifths
    long_notes,       ///< on the beat, with few rests
    any               ///< notes of all lengths
};
/// Names in files of styles, in the order of Melody.
inline constexpr std::array<std::string_view, 6> kMelodyNames = {
    "riffs_ahead", "maqam", "sixteenth_riffs", "fifths", "long_notes", "any"};

/// Music for a dance that the generator in audio/music/generator makes.
struct OwnMusic {
    std::string style;           ///< the generator's name of it
    std::string name;            ///< of such pieces
    double lowest_bpm = 90.0;    ///< slowest tempo of such pieces
    double highest_bpm = 130.0;  ///< fastest
    double share = 0.0;          ///< of the dance's written pieces that are such
};

/// The instruments and chances from which the music for one dance is drawn. Numbers are General
/// MIDI programs, from 0; no list is empty, and what is twice in a list is drawn twice as often.
struct BandPalette {
    std::string dance;             ///< empty: for music that is for none of the dances
    std::vector<int> bass;         ///< programs for the bass line
    std::vector<int> chords;       ///< programs for chords, drones and guitars
    std::vector<int> leads;        ///< programs for melodies
    std::vector<int> kits;         ///< drum kits
    double band_chance = 0.9;      ///< that more than drums plays
    double lead_chance = 0.5;      ///< that a melody of the dance's own plays
    double drumless_chance = 0.0;  ///< that the drums are silent
    BandChances players;           ///< of the band
    Melody melody = Melody::any;   ///< manner of the dance's melodies
    std::optional<OwnMusic> own;   ///< nothing: the generator has no music for it
};

}  // namespace raks::audio
