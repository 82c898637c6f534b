#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audio/evaluate/beat_scores.hpp"
#include "base/expected.hpp"

/// A folder of annotated music and, in another folder, a tracker's estimates for it. All are text
/// files; lines may end in CRLF, empty lines and lines that start with '#' are skipped. Every error
/// is one line, such as `x/waltz.beats: line 7: bar position is "q", must be a whole number from 0
/// to 64`.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// A line of index.tsv.
struct BeatIndexRow {
    std::string name;      ///< of the excerpt's files, without extension
    std::string category;  ///< column `class`: rock, drums, salsa, ...
};

/// Rows of an index: tab-separated; the first line names the columns, of which `name` and `class`
/// are read. Errors: one of these columns is missing, a cell is empty, a name is no plain file name
/// or occurs twice, there are no excerpts. `file`: the name that errors give.
[[nodiscard]] Expected<std::vector<BeatIndexRow>> parse_beat_index(std::string_view text,
                                                                   const std::string& file);

/// Beats, one a line: seconds in [-10, 1e6] and, in all lines or in none, a blank and the bar
/// position (1 = downbeat, 0 = unknown, <= 64); further columns are ignored. Sorted by time.
/// Errors: any other line. A text without beats gives empty lists.
[[nodiscard]] Expected<BeatList> parse_beats(std::string_view text, const std::string& file);

/// The text that parse_beats reads: seconds to the microsecond, then a tab and the bar position
/// where the list has bar positions.
[[nodiscard]] std::string beats_text(const BeatList& beats);

/// One annotated piece of the corpus.
struct BeatExcerpt {
    /// Of the excerpt's files, as in index.tsv.
    std::string name;
    /// Column `class` of index.tsv.
    std::string category;
    /// The annotation: at least one beat, no two at the same time.
    BeatList reference;
    /// NAME.ogg, .wav, .flac, .mp3, .opus or .m4a: the first of these that exists.
    std::filesystem::path audio;
};

/// The excerpts in the order of `folder`/index.tsv. All text files are read and checked; of the
/// sound only its existence. Errors: as the parsers; a file that is missing; an annotation without
/// beats or with two at the same time.
[[nodiscard]] Expected<std::vector<BeatExcerpt>> load_beat_corpus(
    const std::filesystem::path& folder);

/// The estimate in `folder`/NAME.beats and, if it exists, NAME.pred (the same form). Empty optional
/// without NAME.beats. Errors: as parse_beats.
[[nodiscard]] Expected<std::optional<BeatEstimate>> load_beat_estimate(
    const std::filesystem::path& folder, const std::string& name);

/// Writes NAME.beats and, where beats were predicted, NAME.pred. Errors: as write_file.
[[nodiscard]] Expected<void> save_beat_estimate(const std::filesystem::path& folder,
                                                const std::string& name,
                                                const BeatEstimate& estimate);

}  // namespace raks::audio
