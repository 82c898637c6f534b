#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audio/music/score/score.hpp"
#include "base/dice.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// A stretch of a MIDI file in one time signature, as a score: beats are what is tapped (quarters;
/// dotted quarters in 6/8, 9/8, 12/8; the bar in 3/8).
struct MidiStretch {
    /// The notes, with the stretch's first beat at 0.
    Score score;
    std::string set;    ///< "groove", "freedoom", "lieder"
    std::string style;  ///< of groove, as its index says: "rock", "funk", ...; else empty
    /// Of groove: a drum fill rather than a beat; may be shorter than four bars.
    bool is_fill = false;
};

/// A time signature from a place in a MIDI file on.
struct MidiSignature {
    double quarter = 0.0;  ///< where it begins
    int numerator = 4;     ///< 1 to 255
    int denominator = 4;   ///< 1 to 64
};

/// What a pack's index says of one MIDI file.
struct MidiPackRow {
    std::string file;  ///< path from the pack's folder
    std::string set;   ///< "groove", "freedoom", "lieder"
    bool is_fill = false;
    double bpm = 120.0;                        ///< of groove: quarters a minute, 1 to 1000
    std::optional<MidiSignature> signature{};  ///< of groove; none: the file's own
    std::string style{};                       ///< where the index names one
};

/// The rows of an index (columns file, set, kind, bpm_quarter, time_signature, and style where
/// there is one, in any order). Errors, with `name` and line: a missing column, too few of them, a
/// tempo or a time signature that is none, no row.
[[nodiscard]] Expected<std::vector<MidiPackRow>> parse_midi_index(const std::string& text,
                                                                  const std::string& name);

/// All stretches of at least four bars of one MIDI file; of a fill those of any length. What goes
/// beyond 20,000 quarters in all (more than an hour) is left out, as are 5, 7, 8/8, 10, 11, 13 to
/// the bar and tempi outside 52-217 BPM. Errors: as parse_midi.
[[nodiscard]] Expected<std::vector<MidiStretch>> midi_stretches(std::string_view bytes,
                                                                const MidiPackRow& row);

/// All stretches of the files that `folder`/index.tsv names.
/// Errors: no folder, no index, those of parse_midi_index, a file that is not MIDI (its name is
/// said).
[[nodiscard]] Expected<std::vector<MidiStretch>> read_midi_pack(
    const std::filesystem::path& folder);

/// Beats [first_beat, first_beat + beats) of a score, which must have them, the first moved to 0.
[[nodiscard]] Score cut_beats(const Score& score, int first_beat, int beats);

}  // namespace raks::audio
