#include "apps/raks/stick_strips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/grid/beat_strip.hpp"
#include "apps/grid/strip_picture.hpp"
#include "apps/grid/take_figure.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "render/scene/camera.hpp"
#include "render/video/png.hpp"
#include "training/cells/grid_cues.hpp"

namespace raks::apps {
namespace {

// From the front, so near that a body with raised arms fills its tile; a hand at the end of a wide
// spread arm may be cut.
render::PoseSheetConfig strip_sheet() {
    render::PoseSheetConfig config;
    config.columns = kStripColumns;
    config.tile_width = kStripTileWidth;
    config.tile_height = kStripTileHeight;
    render::Camera camera = render::PoseSheetConfig::default_cameras().front();
    camera.distance = 4.5F;
    config.cameras = {camera};
    return config;
}

// The bodies of a page in one sheet, at the middle of the stage.
Expected<render::PoseSheet> draw_bodies(const TakeFigure& figure,
                                        std::span<const StripRow> rows,
                                        SheetStudio& studio) {
    std::vector<motion::Pose> poses;
    for (const StripRow& row : rows) {
        for (const StripPicture& picture : row) {
            motion::Pose pose = figure.at(picture.time);
            pose.hips_position.x = 0.0F;
            pose.hips_position.z = 0.0F;
            poses.push_back(pose);
        }
    }
    // A sheet is as wide as its poses are many.
    while (poses.size() < kStripColumns) {
        poses.push_back(poses.back());
    }
    return studio.draw_sheet(poses, strip_sheet());
}

}  // namespace

Expected<void> write_strips(const motion::TrainingClip& clip,
                            const motion::TakeGrid& grid,
                            const Path& folder,
                            SheetStudio& studio) {
    const TakeFigure figure(clip);
    if (auto checked = motion::check_grid(grid, figure.seconds()); !checked) {
        return checked;
    }
    const motion::GridCues cues = motion::grid_cues(clip);
    const std::vector<StripRow> rows = strip_rows(grid);
    const std::size_t pages = (rows.size() + kStripRows - 1) / kStripRows;
    for (std::size_t page = 0; page < pages; ++page) {
        const std::size_t first = page * kStripRows;
        const auto shown =
            std::span(rows).subspan(first, std::min(kStripRows, rows.size() - first));
        const auto bodies = draw_bodies(figure, shown, studio);
        if (!bodies) {
            return fail(bodies.error());
        }
        const std::string title = fmt::format(
            "{}: beats {} to {} of {}.  Amber: the 1 of half a bar. Teal, orange: left, "
            "right foot lands. Grey: not used",
            printable(grid.take, 60),
            shown.front().front().beat + 1,
            shown.back().back().beat + 1,
            grid.beats.size());
        const render::PoseSheet picture = paint_strip(title, shown, *bodies, cues);
        const Path path = folder / (pages == 1 ? grid.take + ".png"
                                               : fmt::format("{}_{}.png", grid.take, page + 1));
        if (auto written = render::write_png(path, picture.width, picture.height, picture.rgba);
            !written) {
            return written;
        }
        print_text(fmt::format("{}: {} rows of beats\n", printable(path.string()), shown.size()));
    }
    return {};
}

}  // namespace raks::apps
