#include "apps/xbody/xbody_picture.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include "apps/xbody/skeleton_view.hpp"
#include "base/printable.hpp"
#include "render/gl/offscreen.hpp"
#include "render/panes/pane_host.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"
#include "render/video/png.hpp"

#include <fmt/format.h>

namespace raks::apps {

Expected<void> write_xbody_picture(const std::filesystem::path& output,
                                   const ShownModel& model,
                                   const XbodyPicture& picture) {
    if (picture.frame >= model.frame_count()) {
        return fail(fmt::format("{}: has no frame {}, its last is {}",
                                printable(model.file.string()),
                                picture.frame,
                                model.frame_count() - 1));
    }
    const auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto renderer =
        render::Renderer::create(*model.avatar, {.quality = render::Quality::automatic});
    if (!renderer) {
        return fail(renderer.error());
    }
    auto host = render::PaneHost::create();
    if (!host) {
        return fail(host.error());
    }
    const auto [width, height] = picture.size;
    constexpr int kSamples = 4;
    auto target =
        render::OffscreenTarget::create({.width = width, .height = height, .samples = kSamples});
    if (!target) {
        return fail(target.error());
    }
    ShownPose shown(model);
    show_frame(model, picture.frame, shown);
    render::Scene scene;
    scene.theme = render::find_theme("studio_light").value_or(scene.theme);
    scene.camera = camera_before(
        model, shown, picture.view, static_cast<float>(width) / static_cast<float>(height));
    const render::Dancer dancer{.avatar = {}, .pose = shown.pose, .state = &shown.state};
    renderer->draw(scene, std::span(&dancer, 1), target->frame());
    host->draw(target->frame(),
               render::pane_scale(width, height, 1.0F),
               {},
               [&](const render::PaneFrame& frame) {
                   draw_skeleton(frame,
                                 seen_skeleton(model,
                                               shown,
                                               model.figure.model.character.humanoid,
                                               {},
                                               scene.camera,
                                               frame.area),
                                 {.has_names = picture.has_names});
               });
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(height) * 4U);
    if (auto read = target->read_rgba(rgba); !read) {
        return read;
    }
    return render::write_png(output, width, height, rgba);
}

}  // namespace raks::apps
