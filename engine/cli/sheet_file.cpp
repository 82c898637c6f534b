#include "engine/cli/sheet_file.hpp"

#include "render/avatar/avatar.hpp"
#include "render/gl/offscreen_context.hpp"
#include "render/video/png.hpp"

namespace raks::cli {
namespace {

template <typename Body>
Expected<void> write(const Path& output,
                     const engine::Look& look,
                     std::span<const Body> bodies,
                     const render::PoseSheetConfig& config) {
    const auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto renderer = render::Renderer::create(render::build_mannequin(), {.quality = look.quality});
    if (!renderer) {
        return fail(renderer.error());
    }
    const auto picture = render::draw_pose_sheet(*renderer, look.scene, bodies, config);
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

}  // namespace raks::cli
