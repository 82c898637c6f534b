#pragma once

#include <filesystem>
#include <string>
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

/// All stretches of at least four bars of the files that `folder`/index.tsv names (columns
/// file, set, kind, bpm_quarter, time_signature, and style where there is one), paths from
/// `folder`; fills of groove are kept whatever their length. Files in 5, 7, 8/8, 10, 11, 13 and
/// tempi outside 52-217 BPM are left out.
///
/// Errors: no folder, no index, a missing column, a file that is not MIDI (its name is said).
[[nodiscard]] Expected<std::vector<MidiStretch>> read_midi_pack(
    const std::filesystem::path& folder);

/// Beats [first_beat, first_beat + beats) of a score, which must have them, the first moved to 0.
[[nodiscard]] Score cut_beats(const Score& score, int first_beat, int beats);

}  // namespace raks::audio
