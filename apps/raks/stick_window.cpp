#include "apps/raks/stick_window.hpp"

#include <variant>

#include "apps/terminal/signals.hpp"
#include "base/time.hpp"
#include "engine/show/camera_moves.hpp"
#include "engine/show/show.hpp"
#include "render/overlay/key_bindings.hpp"
#include "render/overlay/overlay.hpp"

namespace raks::apps {
namespace {

/// What is not the transport's means the same as in every window.
void act_on(const KeyEvent& key,
            const render::Camera& first,
            render::Window& window,
            render::Scene& scene) {
    const auto action = render::action_of(key);
    if (action == render::Action::quit) {
        window.request_close();
    } else if (action == render::Action::reset_camera) {
        scene.camera = first;
    } else if (action == render::Action::toggle_fullscreen) {
        window.toggle_fullscreen();
    }
}

}  // namespace

Expected<void> play_clip(render::Window& window,
                         const engine::Look& look,
                         const render::ClipFigures& figures,
                         engine::ClipTransport& transport) {
    auto drawing = engine::create_drawing(look);
    if (!drawing) {
        return fail(drawing.error());
    }
    render::Scene scene = look.scene;
    HostTime last = HostClock::now();
    while (!window.should_close() && !stop_signal()) {
        for (const render::WindowEvent& event : window.poll_events()) {
            if (const auto* key = std::get_if<KeyEvent>(&event)) {
                if (!transport.handle(*key)) {
                    act_on(*key, look.scene.camera, window, scene);
                }
            } else if (const auto* drag = std::get_if<render::MouseDragEvent>(&event)) {
                engine::move_camera(scene.camera, *drag);
            } else if (const auto* scroll = std::get_if<render::ScrollEvent>(&event)) {
                engine::move_camera(scene.camera, *scroll);
            }
        }
        const HostTime now = HostClock::now();
        transport.advance(to_seconds(now - last));
        last = now;
        const render::ClipFigure figure = figures.at(transport.frame());
        scene.camera.pan_to(figure.landmarks.position(motion::Bone::hips));
        drawing->renderer.draw(scene, figure, window.frame());
        const std::string status = transport.status();
        render::OverlayState line;
        line.message = status;
        drawing->overlay.draw(
            line, render::OverlayView::hidden, window.frame(), window.content_scale());
        window.present();
    }
    return {};
}

}  // namespace raks::apps
