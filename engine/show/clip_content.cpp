#include "engine/show/clip_content.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raks::engine {

// Distance and height are the mannequin's, scaled by the body's size and kept in the camera's
// range.
render::Camera framed_for(render::Camera camera, const render::RecordedBodies& recorded) {
    constexpr float kDistance = 4.8F;  // for the mannequin's size; metres
    constexpr float kMiddle = 1.0F;
    camera.distance = std::clamp(
        kDistance * recorded.size(), render::Camera::kMinDistance, render::Camera::kMaxDistance);
    camera.target.y = std::min(kMiddle * recorded.size(), render::Camera::kMaxTargetHeight);
    return camera;
}

bool ClipContent::handle(const KeyEvent& key) {
    if (transport_.handle(key)) {
        return true;
    }
    if (key.has_control) {
        return false;
    }
    if (key.key == key_of(U'w') && options_.highlight) {
        transport_.go_to(options_.highlight->frame);
        return true;
    }
    for (const auto& [letter, is_shown] : {std::pair{U'n', &options_.marks.has_names},
                                           std::pair{U't', &options_.marks.has_trails}}) {
        if (key.key == key_of(letter)) {
            // A key that is held repeats; only its first press counts.
            *is_shown = *is_shown != !key.is_repeat;
            return true;
        }
    }
    return false;
}

void ClipContent::use(render::OverlayControl control, double share) {
    switch (control) {
        case render::OverlayControl::play_sign:
            transport_.toggle_pause();
            return;
        case render::OverlayControl::position:
            transport_.go_to_share(share);
            return;
        case render::OverlayControl::mark:
            if (options_.highlight) {
                transport_.go_to(options_.highlight->frame);
            }
            return;
        case render::OverlayControl::help:
            return;  // the loop of the window shows the help
    }
}

std::vector<render::HelpRow> ClipContent::own_keys() const {
    std::vector<render::HelpRow> rows = transport_keys();
    if (options_.highlight) {
        rows.push_back({"CLIP", {"W"}, "to the " + options_.highlight->name + " frame"});
    }
    rows.push_back({"MARKS", {"N"}, "names on, off"});
    rows.push_back({"MARKS", {"T"}, "trails on, off"});
    return rows;
}

// The camera pans with the hips, so that a body that walks stays in the middle; what a person pans
// from there is kept until the camera is let go of.
void ClipContent::follow(const render::ClipBody& body, render::Camera& camera) {
    if (!is_held_) {
        beside_ = {};
    } else if (followed_) {
        beside_ += camera.target - *followed_;
    }
    const glm::vec3 hips = body.landmarks.position(motion::Bone::hips);
    camera.pan_to(hips + beside_);
    followed_ = camera.target;
}

void ClipContent::draw_frame(std::size_t frame,
                             render::Renderer& renderer,
                             render::Scene& scene,
                             const render::FrameTarget& target,
                             render::OverlayState& overlay) {
    const render::ClipBody body = recorded_.at(frame);
    follow(body, scene.camera);
    renderer.draw(scene, body, target);
    marks_.place(
        recorded_, frame, options_.frames_per_second, options_.marks, scene.camera, target);
    overlay.lines = marks_.lines();
    overlay.labels = marks_.labels();
}

void ClipContent::draw(const WindowPicture& picture, render::OverlayState& overlay) {
    is_held_ = picture.camera.is_held;
    draw_frame(transport_.frame(), picture.renderer, picture.scene, picture.target, overlay);
    render::OverlayTransport transport = transport_.picture();
    if (options_.highlight) {
        transport.curve = options_.highlight->curve;
        transport.mark = options_.highlight->frame;
        transport.mark_name = options_.highlight->name;
    }
    overlay.transport = transport;
}

render::Camera ClipContent::framed(render::Camera preset) const {
    constexpr float kAspect = 4.0F / 3.0F;  // of a narrow window
    render::Camera camera = framed_for(preset, recorded_);
    for (const std::size_t frame : options_.framed_frames) {
        camera = render::enclosing(camera, kAspect, recorded_.at(frame));
    }
    if (options_.has_bar) {
        // Smaller by the bar's share of the picture, and higher by half of it.
        constexpr float kBar = 0.13F;
        camera.zoom(1.0F / (1.0F - kBar));
        const float seen = 2.0F * camera.distance * std::tan(0.5F * camera.vertical_fov);
        camera.pan(0.0F, -0.5F * kBar * seen);
    }
    return camera;
}

}  // namespace raks::engine
