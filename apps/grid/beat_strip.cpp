#include "apps/grid/beat_strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/grid/grid_edits.hpp"
#include "apps/grid/take_figure.hpp"
#include "base/printable.hpp"

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

Expected<std::vector<StripPage>> strip_pages(const motion::TrainingClip& clip,
                                             const motion::TakeGrid& grid) {
    const TakeFigure figure(clip);
    if (auto checked = motion::check_grid(grid, figure.seconds()); !checked) {
        return fail(std::move(checked.error()));
    }
    const std::vector<StripRow> rows = strip_rows(grid);
    std::vector<StripPage> pages;
    for (std::size_t first = 0; first < rows.size(); first += kStripRows) {
        StripPage& page = pages.emplace_back();
        const std::size_t last = std::min(first + kStripRows, rows.size());
        page.rows.assign(rows.begin() + static_cast<std::ptrdiff_t>(first),
                         rows.begin() + static_cast<std::ptrdiff_t>(last));
        page.name =
            rows.size() <= kStripRows ? grid.take : fmt::format("{}_{}", grid.take, pages.size());
        page.title = fmt::format(
            "{}: beats {} to {} of {}.  Amber: the 1 of half a bar. Teal, orange: left, "
            "right foot lands. Grey: not used",
            printable(grid.take, 60),
            page.rows.front().front().beat + 1,
            page.rows.back().back().beat + 1,
            grid.beats.size());
        for (const StripRow& row : page.rows) {
            for (const StripPicture& picture : row) {
                motion::Pose& pose = page.poses.emplace_back(figure.at(picture.time));
                pose.hips_position.x = 0.0F;
                pose.hips_position.z = 0.0F;
            }
        }
    }
    return pages;
}

}  // namespace raks::apps
