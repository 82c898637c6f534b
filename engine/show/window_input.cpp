// What keys, mouse and dropped files do in a window.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/printable.hpp"
#include "engine/control/action_table.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/window.hpp"
#include "render/import/model_reader.hpp"
#include "render/scene/camera.hpp"

namespace raks::engine {
namespace {

// A drag with the left button orbits; with another button, or with Shift, it pans.
void move_camera(render::Camera& camera, const render::MouseDragEvent& drag) {
    constexpr float kOrbitPerPixel = 0.008F;  // radians
    constexpr float kPanPerPixel = 0.002F;    // metres
    if (drag.button == render::MouseButton::left && !drag.has_shift) {
        camera.orbit(-drag.dx * kOrbitPerPixel, drag.dy * kOrbitPerPixel);
    } else {
        camera.pan(-drag.dx * kPanPerPixel, drag.dy * kPanPerPixel);
    }
}

// The wheel zooms: one step is a tenth nearer or further.
void move_camera(render::Camera& camera, const render::ScrollEvent& scroll) {
    constexpr float kZoomPerStep = 0.9F;
    camera.zoom(std::pow(kZoomPerStep, scroll.dy));
}

}  // namespace

// Mouse and wheel act on the camera at once; keys become actions.
void WindowLoop::handle_events(WindowContent& content, const ActionDispatcher& actions) {
    for (const render::WindowEvent& event : std::exchange(waiting_, {})) {
        handle(event, content, actions);
    }
    for (const render::WindowEvent& event : window_.poll_events()) {
        handle(event, content, actions);
    }
}

void WindowLoop::handle(const render::WindowEvent& event,
                        WindowContent& content,
                        const ActionDispatcher& actions) {
    if (const auto* key = std::get_if<KeyEvent>(&event)) {
        handle(*key, content, actions);
    } else if (const auto* drag = std::get_if<render::MouseDragEvent>(&event)) {
        handle(*drag, content);
    } else if (const auto* button = std::get_if<render::MouseButtonEvent>(&event)) {
        handle(*button, content, actions);
    } else if (const auto* scroll = std::get_if<render::ScrollEvent>(&event);
               scroll != nullptr && list_.is_open()) {
        list_.scroll(static_cast<double>(scroll->dy));
    } else if (scroll != nullptr) {
        move_camera(scene_.camera, *scroll);
        is_camera_held_ = true;
    } else if (const auto* drop = std::get_if<render::DropEvent>(&event)) {
        if (!content.take_dropped(drop->paths)) {
            handle(*drop, content);
        }
    }
}

void WindowLoop::handle(const KeyEvent& key,
                        WindowContent& content,
                        const ActionDispatcher& actions) {
    if (list_.handle(key)) {
        return;
    }
    if (key.key == Key::escape && help_.is_open()) {
        help_.close();
        return;
    }
    // The content's own keys shadow those of the table.
    if (content.handle(key)) {
        return;
    }
    const auto request = request_of(key);
    if (!request || !actions.handles(request->action)) {
        return;  // a key that means nothing here
    }
    if (const auto done = actions.dispatch(*request); !done) {
        // Errors are shown, not fatal: the show goes on.
        say(done.error().message);
    }
}

// A click on the overlay uses it; anywhere else it begins to move the camera.
void WindowLoop::handle(const render::MouseButtonEvent& button,
                        WindowContent& content,
                        const ActionDispatcher& actions) {
    is_position_held_ = false;
    is_click_taken_ = false;
    pointer_x_ = button.x;
    const bool is_click = button.is_down && button.button == render::MouseButton::left;
    const auto spot = controls_.spot_at(button.x, button.y);
    if (spot || (is_click && list_.is_open())) {
        is_click_taken_ = true;
        if (is_click && spot) {
            click_panel(*spot, content, actions);
        } else if (is_click) {
            list_.close();
        }
        return;
    }
    const auto control = controls_.at(button.x, button.y);
    // Who turns the camera twice in a row does not click.
    const bool was_dragged = is_click && std::exchange(has_dragged_, false);
    if (is_click && button.is_double && !was_dragged && !control) {
        window_.toggle_fullscreen();
    }
    if (!is_click || !control) {
        return;
    }
    is_click_taken_ = true;
    if (*control == render::OverlayControl::help) {
        toggle_help(content, actions);
        return;
    }
    is_position_held_ = *control == render::OverlayControl::position;
    content.use(*control, controls_.share_at(pointer_x_));
}

// A key of the list is pressed by a click on it.
void WindowLoop::click_panel(const render::OverlaySpot& spot,
                             WindowContent& content,
                             const ActionDispatcher& actions) {
    if (list_.is_open()) {
        list_.click(spot);
    } else if (spot.part == render::PanelPart::keys_head) {
        toggle_help(content, actions);
    } else if (const auto key = help_.key_at(spot)) {
        handle(*key, content, actions);
    }
}

void WindowLoop::handle(const render::MouseDragEvent& drag, WindowContent& content) {
    has_dragged_ = true;
    pointer_x_ += drag.dx;
    if (is_position_held_) {
        content.use(render::OverlayControl::position, controls_.share_at(pointer_x_));
    } else if (!is_click_taken_) {
        move_camera(scene_.camera, drag);
        is_camera_held_ = true;
    }
}

// Models that are dropped together are worn in turn; nothing else is taken.
void WindowLoop::handle(const render::DropEvent& drop, const WindowContent& content) {
    std::vector<std::string> models;
    for (const std::string& path : drop.paths) {
        if (!content.has_avatar()) {
            say("no avatar is shown here: drop models on the window of play or live");
        } else if (render::is_model_name(path)) {
            models.push_back(path);
        } else {
            say(printable(path) +
                ": only models are taken here: .vrm, .glb, .gltf, .3ds, .fbx, .dae, .obj");
        }
    }
    if (models.size() > kMostAvatars) {
        say(fmt::format("of {} models the first {} are taken", models.size(), kMostAvatars));
        models.resize(kMostAvatars);
    }
    if (!models.empty()) {
        wear(std::move(models));
    }
}

}  // namespace raks::engine
