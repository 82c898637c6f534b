#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/beat_scores.hpp"
#include "base/expected.hpp"

/// A folder of annotated music, and what trackers said about it. Text files; line ends may be CRLF,
/// empty lines and lines from '#' are skipped. Every error is one line: `x/waltz.beats: line 7: bar
/// position is "q", must be a whole number from 0 to 64`.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// A line of index.tsv.
struct BeatIndexRow {
    std::string name;      ///< of the files, without extension
    std::string category;  ///< column `class`: rock, drums, salsa, ...
};

/// Tab-separated; the first line names the columns, of which `name` and `class` are read. Errors:
/// one of them missing, an empty cell, a name that is no plain file name or comes twice, no
/// excerpts. `file`: how errors call it.
[[nodiscard]] Expected<std::vector<BeatIndexRow>> parse_beat_index(std::string_view text,
                                                                   const std::string& file);

/// One beat a line: seconds in [-10, 1e6], and, in all lines or none, a blank and the bar position
/// (1 = downbeat, 0 = unknown, <= 64); more columns are ignored. Sorted by time. Errors: anything
/// else. Without beats nothing is told of bars.
[[nodiscard]] Expected<BeatList> parse_beats(std::string_view text, const std::string& file);

/// What parse_beats reads: microseconds, tab, bar position where bars are told.
[[nodiscard]] std::string beats_text(const BeatList& beats);

struct BeatExcerpt {
    std::string name;
    std::string category;
    BeatList reference;
    std::filesystem::path
        audio;  ///< NAME.ogg, .wav, .flac, .mp3, .opus or .m4a, the first there is
};

/// The excerpts in the order of `folder`/index.tsv, all files checked but for the sound. Errors: as
/// the parsers, a file that is missing, an annotation without beats or with two at one moment.
[[nodiscard]] Expected<std::vector<BeatExcerpt>> load_beat_corpus(
    const std::filesystem::path& folder);

/// `folder`/NAME.beats and, if there, NAME.pred (same form). Empty without NAME.beats. Errors: as
/// parse_beats.
[[nodiscard]] Expected<std::optional<BeatEstimate>> load_beat_estimate(
    const std::filesystem::path& folder, const std::string& name);

/// Writes NAME.beats and, where beats were predicted, NAME.pred. Errors: as write_file.
[[nodiscard]] Expected<void> save_beat_estimate(const std::filesystem::path& folder,
                                                const std::string& name,
                                                const BeatEstimate& estimate);

}  // namespace raks::audio
