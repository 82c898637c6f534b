#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raks::audio {

/// The rhythm and the tones of a bass line.
enum class BassLine : std::uint8_t {
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
/// Names in files of styles, in the order of BassLine.
inline constexpr std::array<std::string_view, 13> kBassLineNames = {"none",
                                                                    "eighths",
                                                                    "quarters",
                                                                    "octaves",
                                                                    "off_beat",
                                                                    "gallop",
                                                                    "random_cell",
                                                                    "whole_bar",
                                                                    "walking",
                                                                    "root_fifth",
                                                                    "surdo",
                                                                    "tumbao",
                                                                    "habanera"};

/// The rhythm of an accompaniment in chords.
enum class Comping : std::uint8_t {
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
/// Names in files of styles, in the order of Comping.
inline constexpr std::array<std::string_view, 9> kCompingNames = {"none",
                                                                  "held",
                                                                  "quarters",
                                                                  "eighths",
                                                                  "after_beats",
                                                                  "arpeggio16",
                                                                  "arpeggio8",
                                                                  "random_cell",
                                                                  "montuno"};

/// What one drum plays over the cell.
struct DrumLane {
    int key = 36;  ///< of General MIDI's percussion map, 0 to 127
    /// Steps over the cell: 'X' loud, 'x' medium, 'o' soft, '.' none. Variants are parted by '|',
    /// and one is drawn a piece.
    std::string pattern;
    double chance = 1.0;  ///< that it plays in a piece; (0, 1]
};

/// Which dance some music is for.
struct DanceLabel {
    std::string dance;  ///< its name; empty: none of the dances
    /// The genre training can leave out the rhythms that are held out, to evaluate the model on
    /// arrangements that it was not trained on; one or two rhythms a dance are.
    enum class Use : std::uint8_t { always, held_out };
    Use use = Use::always;  ///< what the file says, or always
};
/// Names in files of styles, in the order of DanceLabel::Use.
inline constexpr std::array<std::string_view, 2> kUseNames = {"always", "held_out"};

/// A rhythm: what the instruments play over a cell of some beats, which is repeated.
struct RhythmStyle {
    std::string name;    ///< unique in a book
    std::string family;  ///< to leave a class of music out: "latin", "belly", "pop", ...
    /// The dance that its music is for. Nothing: it is neither clearly for a dance nor clearly for
    /// none, and the genre training leaves it out.
    std::optional<DanceLabel> label;
    bool is_for_beats = true;      ///< whether the beat tracker's training has it
    bool is_by_machines = false;   ///< played by drum machines and synthesizers
    double lowest_bpm = 90.0;      ///< 30 to 300
    double highest_bpm = 130.0;    ///< >= lowest_bpm, up to 300
    int beats_per_bar = 4;         ///< 1 to 12
    int cell_beats = 4;            ///< whole bars
    int steps_per_beat = 4;        ///< letters of a pattern for each beat, 1 to 24
    std::vector<DrumLane> lanes;   ///< not empty
    std::vector<BassLine> bass;    ///< one is drawn a piece; empty: of those that fit most music
    std::vector<Comping> comping;  ///< as the bass
    double weight = 1.0;           ///< how often it is drawn, relative to the others; above 0
};

}  // namespace raks::audio
