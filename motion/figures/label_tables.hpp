#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"

/// Label tables: tab-separated files that say what is danced where in a take. The first line names
/// the columns, in any order; unknown columns are ignored. Line ends may be CRLF; empty lines and
/// lines that start with '#' are skipped. Every error is one line: `labels.tsv: line 7: end is 300,
/// must be after start (311)`.
namespace raks::motion {

/// One labelled repeat of a figure. Frames count from 0; `end` is the first frame after it.
struct FigureLabel {
    std::string take;                  ///< the clip's file name without extension
    DanceRole role = DanceRole::lead;  ///< whose clip
    std::size_t start = 0;             ///< first frame
    std::size_t end = 0;               ///< first frame after it
    std::string figure;                ///< name
    int start_count = 1;               ///< count at `start`, 1 to beats
    int beats = 8;                     ///< its length; 0: not given (BeatsColumn::optional)
    double confidence = 1.0;           ///< [0, 1]
    std::string split;                 ///< "train", "test" or empty
    std::size_t line = 0;              ///< in the file, counted from 1
};

/// Whether the column `beats` must be there.
enum class BeatsColumn : std::uint8_t { required, optional };

/// Reads labels. Columns take, role, start, end, figure, beats; optional start_count, confidence,
/// split. Errors: a missing column, a cell that is no number, an end that is not after its start,
/// fewer than 4 frames a beat (so also labels of one frame), labels of one take that overlap.
/// `name` stands for the file.
[[nodiscard]] Expected<std::vector<FigureLabel>> parse_labels(
    std::string_view text, const std::string& name, BeatsColumn beats = BeatsColumn::required);
/// The same from a file of at most 64 MiB. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<FigureLabel>> load_labels(
    const std::filesystem::path& path, BeatsColumn beats = BeatsColumn::required);

/// Labels as a table that parse_labels reads: take, role, start, end, figure, beats, confidence.
/// Each line of `remarks` becomes a line that readers skip.
[[nodiscard]] std::string labels_text(std::span<const FigureLabel> labels,
                                      std::span<const std::string> remarks = {});

/// The moment of one count in a take.
struct CountTime {
    /// As in labels, or only the part after its first '_' (names a pair of takes)
    std::string take;
    int count = 1;       ///< from 1
    double frame = 0.0;  ///< fractional
};

/// Reads counts. Columns take (or take_pair), count, frame. Errors: as for labels; frames of one
/// take that do not rise.
[[nodiscard]] Expected<std::vector<CountTime>> parse_counts(std::string_view text,
                                                            const std::string& name);
/// The same from a file. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<CountTime>> load_counts(const std::filesystem::path& path);

/// One beat of a take.
struct TakeBeat {
    std::string take;      ///< the clip's file name without extension
    double time = 0.0;     ///< seconds from the clip's first frame
    int half = 1;          ///< of the bar, 1 or 2
    bool is_used = true;   ///< the beat that begins here may be danced
    std::size_t line = 0;  ///< in the file, counted from 1
};

/// Reads the beats of takes. Columns take, time, half, used (0 or 1). Errors: as for labels; a row
/// without a take, times of one take that do not rise, a table without beats.
[[nodiscard]] Expected<std::vector<TakeBeat>> parse_take_beats(std::string_view text,
                                                               const std::string& name);
/// The same from a file. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<TakeBeat>> load_take_beats(const std::filesystem::path& path);

/// Frames [from, to] of a take that were captured or converted badly.
struct CaptureFault {
    std::string take;      ///< the clip's file name without extension
    std::size_t from = 0;  ///< first frame
    std::size_t to = 0;    ///< last frame, included
    std::string joints;    ///< names separated by commas, or "all"
};

/// Reads faults. Columns take, from, to, joints. Errors: as for labels; a `to` before its `from`.
[[nodiscard]] Expected<std::vector<CaptureFault>> parse_faults(std::string_view text,
                                                               const std::string& name);
/// The same from a file. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<CaptureFault>> load_faults(const std::filesystem::path& path);

}  // namespace raks::motion
