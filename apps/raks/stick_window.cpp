#include "apps/raks/stick_window.hpp"

#include <algorithm>
#include <utility>

#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"

namespace raks::apps {

Expected<render::Window> open_stick_window(const std::string& name,
                                           const engine::Look& look,
                                           const engine::Settings& settings) {
    return render::Window::create({.title = "Raks: " + name,
                                   .width = look.size.width,
                                   .height = look.size.height,
                                   .max_fps = settings.fps});
}

Expected<void> show_in_window(render::Window window,
                              const engine::Look& look,
                              engine::WindowContent& content) {
    // No cards: there is no music to inform about.
    auto loop =
        engine::WindowLoop::create(std::move(window),
                                   look,
                                   {.cards = engine::Cards::none,
                                    .say = say,
                                    .say_detail = say_detail,
                                    .is_stop_requested = [] { return stop_signal().has_value(); }});
    if (!loop) {
        return fail(loop.error());
    }
    // The quality that the renderer chose by itself.
    if (const std::string notice(loop->notice()); !notice.empty()) {
        loop->say(notice);
    }
    engine::ActionDispatcher actions([&](const std::string& line) { loop->say(line); });
    static_cast<void>(loop->run(content, actions));
    return {};
}

// Distance and height are the mannequin's, scaled by the body's size and kept in the camera's
// range.
render::Camera framed(render::Camera camera, const render::RecordedFigures& figures) {
    constexpr float kDistance = 4.8F;  // for the mannequin's size; metres
    constexpr float kMiddle = 1.0F;
    camera.distance = std::clamp(
        kDistance * figures.size(), render::Camera::kMinDistance, render::Camera::kMaxDistance);
    camera.target.y = std::min(kMiddle * figures.size(), render::Camera::kMaxTargetHeight);
    return camera;
}

std::vector<render::HelpRow> ClipContent::own_keys() const {
    return {{"CLIP", {"Space"}, "pause, go on"},
            {"CLIP", {"Left", "Right"}, "a frame back, on"},
            {"CLIP", {"Shift+Left", "Shift+Right"}, "ten frames back, on"},
            {"CLIP", {"Home", "End"}, "first, last frame"},
            {"CLIP", {"0-9", "Enter"}, "go to this frame"}};
}

void ClipContent::draw(const engine::WindowPicture& picture, render::OverlayState& overlay) {
    // The camera pans with the hips, so that a body that walks stays in the middle.
    const render::ClipFigure figure = figures_.at(transport_.frame());
    picture.scene.camera.pan_to(figure.landmarks.position(motion::Bone::hips));
    picture.renderer.draw(picture.scene, figure, picture.target);
    status_ = transport_.status();
    overlay.message = status_;
}

render::Camera ClipContent::framed(render::Camera preset) const {
    constexpr float kAspect = 4.0F / 3.0F;  // of a narrow window
    render::Camera camera = apps::framed(preset, figures_);
    for (const std::size_t frame : framed_frames_) {
        camera = render::enclosing(camera, kAspect, figures_.at(frame));
    }
    return camera;
}

}  // namespace raks::apps
