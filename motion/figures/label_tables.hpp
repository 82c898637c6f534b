#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"

/// Tab-separated tables that say what is danced where. First line: names of the columns, in any
/// order; others are ignored. Line ends may be CRLF; empty lines and lines from '#' are skipped.
/// Every error is one line: `labels.tsv: line 7: end is 300, must be after start (311)`.
namespace raks::motion {

/// One labelled repetition. Frames count from 0; `end` is the next figure's first frame.
struct FigureLabel {
    std::string take;  ///< the clip's file name without extension
    DanceRole role = DanceRole::lead;
    std::size_t start = 0;
    std::size_t end = 0;
    std::string figure;
    int start_count = 1;      ///< count at `start`, 1 to beats
    int beats = 8;            ///< 0: not said (BeatsColumn::optional)
    double confidence = 1.0;  ///< [0, 1]
    std::string split;        ///< "train", "test" or empty
    std::size_t line = 0;     ///< in the file, from 1
};

/// Whether labels must say how many beats they have.
enum class BeatsColumn : std::uint8_t { required, optional };

/// Columns take, role, start, end, figure, beats; optional start_count, confidence, split. Errors:
/// a missing column, a number that is none, an end that is not after its start, less than 4 frames
/// a beat (so also labels of one frame), labels of one take that overlap.
[[nodiscard]] Expected<std::vector<FigureLabel>> parse_labels(
    std::string_view text, const std::string& name, BeatsColumn beats = BeatsColumn::required);
[[nodiscard]] Expected<std::vector<FigureLabel>> load_labels(
    const std::filesystem::path& path, BeatsColumn beats = BeatsColumn::required);

/// The moment of one count.
struct CountTime {
    std::string take;  ///< as in labels, or only what stands behind its first '_' (a pair of takes)
    int count = 1;     ///< from 1
    double frame = 0.0;
};

/// Columns take (or take_pair), count, frame. Errors: as above; frames of one take that do not
/// rise.
[[nodiscard]] Expected<std::vector<CountTime>> parse_counts(std::string_view text,
                                                            const std::string& name);
[[nodiscard]] Expected<std::vector<CountTime>> load_counts(const std::filesystem::path& path);

/// Frames [from, to] of a take that were captured or converted badly.
struct CaptureFault {
    std::string take;
    std::size_t from = 0;
    std::size_t to = 0;
    std::string joints;  ///< comma-separated; "all"
};

/// Columns take, from, to, joints.
[[nodiscard]] Expected<std::vector<CaptureFault>> parse_faults(std::string_view text,
                                                               const std::string& name);
[[nodiscard]] Expected<std::vector<CaptureFault>> load_faults(const std::filesystem::path& path);

}  // namespace raks::motion
