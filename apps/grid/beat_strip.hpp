// Beat strip: the pictures by which a person judges the beats of a take.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "training/cells/take_grid.hpp"

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

}  // namespace raks::apps
