#include "apps/raks/sheet_file.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "render/gl/offscreen.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/video/png.hpp"
#include "render/video/video_writer.hpp"

namespace raks::apps {
namespace {

// What sheets and films are drawn with. The context is destroyed after the renderer, which needs
// it.
struct Studio {
    render::OffscreenContext context;
    render::Renderer renderer;
};

// Errors: no OpenGL context, or the driver refuses.
Expected<Studio> open_studio(const engine::Look& look) {
    auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto renderer = render::Renderer::create(render::build_mannequin(), {.quality = look.quality});
    if (!renderer) {
        return fail(renderer.error());
    }
    return Studio{std::move(*context), std::move(*renderer)};
}

// Poses and clip figures alike: the sheet is a template over what is drawn.
template <typename Body>
Expected<void> write(const Path& output,
                     const engine::Look& look,
                     std::span<const Body> bodies,
                     const render::PoseSheetConfig& config) {
    auto studio = open_studio(look);
    if (!studio) {
        return fail(studio.error());
    }
    const auto picture = render::draw_pose_sheet(studio->renderer, look.scene, bodies, config);
    if (!picture) {
        return fail(picture.error());
    }
    return render::write_png(output, picture->width, picture->height, picture->rgba);
}

}  // namespace

Expected<void> write_sheet(const Path& output,
                           const engine::Look& look,
                           std::span<const motion::Pose> poses,
                           const render::PoseSheetConfig& config) {
    return write(output, look, poses, config);
}

Expected<void> write_sheet(const Path& output,
                           const engine::Look& look,
                           std::span<const render::ClipFigure> figures,
                           const render::PoseSheetConfig& config) {
    return write(output, look, figures, config);
}

Expected<void> write_film(const Path& output,
                          const engine::Look& look,
                          std::span<const motion::Pose> poses,
                          double fps) {
    // The sheet's layout also says size and cameras of one view.
    const render::PoseSheetConfig config;
    const auto views = static_cast<int>(config.cameras.size());
    auto studio = open_studio(look);
    if (!studio) {
        return fail(studio.error());
    }
    auto target = render::OffscreenTarget::create({.width = views * config.tile_width,
                                                   .height = config.tile_height,
                                                   .samples = studio->renderer.samples()});
    if (!target) {
        return fail(target.error());
    }
    auto writer = render::VideoWriter::create(output,
                                              {.width = target->width(),
                                               .height = target->height(),
                                               .rate = render::FrameRate::nearest(fps),
                                               .audio_channels = 0});
    if (!writer) {
        return fail(writer.error());
    }
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(target->width()) *
                                   static_cast<std::size_t>(target->height()) * 4U);
    render::Scene scene = look.scene;
    // One pose a picture; the views lie side by side.
    for (const motion::Pose& pose : poses) {
        for (int view = 0; view < views; ++view) {
            scene.camera = config.cameras[static_cast<std::size_t>(view)];
            // The camera follows the body over the floor.
            scene.camera.pan_to(pose.hips_position);
            render::FrameTarget tile = target->frame();
            tile.x = view * config.tile_width;
            tile.width = config.tile_width;
            studio->renderer.draw(scene, pose, tile);
        }
        auto added = target->read_rgba(rgba);
        if (added) {
            added = (*writer)->add_picture(rgba);
        }
        if (!added) {
            return added;
        }
    }
    return (*writer)->finish();
}

}  // namespace raks::apps
