#include "apps/grid/beat_strip.hpp"

#include "apps/grid/grid_edits.hpp"

namespace raks::apps {

std::vector<StripRow> strip_rows(const motion::TakeGrid& grid) {
    std::vector<StripRow> rows;
    int column = kStripColumns;
    for (std::size_t i = 0; i < grid.beats.size(); ++i) {
        const motion::GridBeat& beat = grid.beats[i];
        const bool follows = i > 0 && beat.time - grid.beats[i - 1].time <= kLongestBeat &&
                             beat.half != grid.beats[i - 1].half;
        if (!follows || column >= kStripColumns) {
            rows.emplace_back();
            // A beat of the second half leaves the place of the one before it free.
            column = beat.half == 2 ? 2 : 0;
        }
        rows.back().push_back({beat.time, i, false, beat.is_used, beat.half == 1, column});
        const bool has_next =
            i + 1 < grid.beats.size() && grid.beats[i + 1].time - beat.time <= kLongestBeat;
        if (has_next) {
            rows.back().push_back({0.5 * (beat.time + grid.beats[i + 1].time),
                                   i,
                                   true,
                                   beat.is_used,
                                   false,
                                   column + 1});
        }
        column += 2;
    }
    return rows;
}

}  // namespace raks::apps
