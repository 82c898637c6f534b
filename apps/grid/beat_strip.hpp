// Beat strip: the pictures by which a person judges the beats of a take.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/pose.hpp"
#include "training/cells/take_grid.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::apps {

/// Beats of a row of a strip; each has two pictures.
inline constexpr int kStripBeats = 8;
/// Pictures of a row.
inline constexpr int kStripColumns = 2 * kStripBeats;
/// Rows of a page: more would be too small where a page is looked at as a whole.
inline constexpr std::size_t kStripRows = 8;

/// One picture of a strip: the body on a beat, or half way to the next one.
struct StripPicture {
    double time = 0.0;      ///< seconds of the clip
    std::size_t beat = 0;   ///< of the grid, from 0: that it shows or follows
    bool is_half = false;   ///< half way to the next beat
    bool is_used = true;    ///< its beat may be danced
    bool is_first = false;  ///< on a beat of the first half of the bar
    int column = 0;         ///< 0 to kStripColumns - 1
};
/// Pictures beside one another, by column.
using StripRow = std::vector<StripPicture>;

/// The rows of a grid: eight beats each, from a beat of the first half of the bar on. A new row
/// begins where halves do not alternate, and behind a gap between beats of more than 1.5 s, in
/// which there is no picture either. Of the last beat before a gap only the beat itself is shown.
[[nodiscard]] std::vector<StripRow> strip_rows(const motion::TakeGrid& grid);

/// A page of a strip.
struct StripPage {
    std::string name;  ///< of its file, without ending: the take's, with a number where it has more
    std::string title;  ///< above it
    std::vector<StripRow> rows;
    std::vector<motion::Pose> poses;  ///< of its pictures in order, at the middle of the stage
};

/// The pages of a take's beats. Errors: beats behind the end of the clip.
[[nodiscard]] Expected<std::vector<StripPage>> strip_pages(const motion::TrainingClip& clip,
                                                           const motion::TakeGrid& grid);

}  // namespace raks::apps
