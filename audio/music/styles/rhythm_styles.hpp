#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace raks::audio {

/// How the bass goes.
enum class BassLine : char {
    none,
    eighths,
    quarters,
    octaves,
    off_beat,
    gallop,  ///< three sixteenths after each beat (trance)
    random_cell,
    whole_bar,
    walking,
    root_fifth,
    surdo,
    tumbao,  ///< 2+ and 4, the next chord already on 4
    habanera
};

/// How the chords go.
enum class Comping : char {
    none,
    held,
    quarters,
    eighths,
    after_beats,
    arpeggio16,
    arpeggio8,
    random_cell,
    montuno
};

/// One instrument's row: steps over the cell, 'X' loud, 'x' medium, 'o' soft, '.' none; variants
/// parted by '|', one is drawn a piece; spaces and bar lines for the eye are not allowed inside.
struct StyleLane {
    int key = 36;
    std::string_view pattern;
    double chance = 1.0;  ///< that it plays in a piece
};

/// A rhythm: what the instruments play over a cell of some beats, again and again.
struct RhythmStyle {
    std::string_view name;
    std::string_view family;  ///< to leave a class of music out: "latin", "belly", "pop", ...
    double lowest_bpm = 90.0;
    double highest_bpm = 130.0;
    int beats_per_bar = 4;
    int cell_beats = 4;
    int steps_per_beat = 4;
    std::vector<StyleLane> lanes;
    std::vector<BassLine> bass;  ///< one is drawn a piece
    std::vector<Comping> comping;
    double weight = 1.0;  ///< how often, beside the others
};

/// How likely each player of a band is there.
struct BandChances {
    double bass = 0.85;
    double chords = 0.8;
    double lead = 0.55;
};

/// The styles that are generated, since no free recordings of them exist.
[[nodiscard]] std::span<const RhythmStyle> rhythm_styles();

}  // namespace raks::audio
