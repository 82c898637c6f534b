#include "apps/raks/stick_strips.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "apps/grid/beat_strip.hpp"
#include "apps/grid/strip_picture.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "render/pose_sheet.hpp"
#include "render/scene/camera.hpp"
#include "render/video/png.hpp"

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
    camera.distance = 3.7F;
    config.cameras = {camera};
    return config;
}

}  // namespace

Expected<void> write_strips(const ReadTake& take,
                            const motion::TakeGrid& grid,
                            const Path& folder,
                            SheetStudio& studio) {
    auto pages = strip_pages(take.clip, grid);
    if (!pages) {
        return fail(std::move(pages.error()));
    }
    for (StripPage& page : *pages) {
        // A sheet is as wide as its poses are many.
        while (page.poses.size() < kStripColumns) {
            page.poses.push_back(page.poses.back());
        }
        const auto bodies = studio.draw_sticks(page.poses, strip_sheet());
        if (!bodies) {
            return fail(bodies.error());
        }
        const render::PoseSheet picture = paint_strip(page.title, page.rows, *bodies, take.cues);
        const Path path = folder / (page.name + ".png");
        if (auto written = render::write_png(path, picture.width, picture.height, picture.rgba);
            !written) {
            return written;
        }
        print_text(fmt::format("{}: beats {} to {}\n",
                               printable(path.string()),
                               page.rows.front().front().beat + 1,
                               page.rows.back().back().beat + 1));
    }
    return {};
}

}  // namespace raks::apps
