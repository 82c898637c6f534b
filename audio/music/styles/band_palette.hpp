#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raks::audio {

/// How likely each player of a band is there.
struct BandChances {
    double bass = 0.85;
    double chords = 0.8;
    double lead = 0.55;
};

/// The manner of a melody.
enum class Melody : std::uint8_t {
    riffs_ahead,      ///< riffs of one to three voices, mostly ahead of the beat, as brass plays
    maqam,            ///< one voice in a maqam that others follow a little late, over a drone
    sixteenth_riffs,  ///< riffs of sixteenths with wide leaps
    fifths,           ///< eighths and quarters; a guitar plays roots with their fifths below
    long_notes,       ///< on the beat, with few rests
    any               ///< notes of all lengths
};
inline constexpr std::array<std::string_view, 6> kMelodyNames = {
    "riffs_ahead", "maqam", "sixteenth_riffs", "fifths", "long_notes", "any"};

/// Music of our own generator for a dance.
struct OwnMusic {
    std::string style;  ///< the generator's name of it
    std::string name;   ///< of such pieces
    double lowest_bpm = 90.0;
    double highest_bpm = 130.0;
    double share = 0.0;  ///< of the dance's written pieces that are such
};

/// What a band is drawn from that plays music for one dance. Numbers are General MIDI programs,
/// from 0; no list is empty, and what is twice in a list is drawn twice as often.
struct BandPalette {
    std::string dance;  ///< empty: for music that is for none of the dances
    std::vector<int> bass;
    std::vector<int> chords;
    std::vector<int> leads;
    std::vector<int> kits;         ///< drum kits
    double band_chance = 0.9;      ///< that more than drums plays
    double lead_chance = 0.5;      ///< that a melody of the dance's own plays
    double drumless_chance = 0.0;  ///< that the drums are silent
    BandChances players;           ///< of the band
    Melody melody = Melody::any;
    std::optional<OwnMusic> own;
};

}  // namespace raks::audio
