#include "render/panes/pane_window.hpp"

#include <epoxy/gl.h>

#include <utility>

#include "base/time.hpp"

namespace raks::render {
namespace {

// A press is drawn a frame after it was taken up, and what it changed one later.
constexpr int kFramesAfterInput = 3;
constexpr Nanos kRest = std::chrono::milliseconds(12);      // between two looks for input
constexpr Nanos kAtLeast = std::chrono::milliseconds(250);  // a window that was covered shows again

}  // namespace

PaneWindow::PaneWindow(Window window, PaneHost host)
    : window_(std::move(window)), host_(std::move(host)) {}

Expected<PaneWindow> PaneWindow::create(const WindowOptions& options) {
    auto window = Window::create(options);
    if (!window) {
        return fail(std::move(window.error()));
    }
    auto host = PaneHost::create();
    if (!host) {
        return fail(std::move(host.error()));
    }
    return PaneWindow(std::move(*window), std::move(*host));
}

void PaneWindow::run(PaneContent& content, const std::function<bool()>& is_stop_requested) {
    int frames_due = kFramesAfterInput;
    PointerPlace pointer;
    FrameTarget target;
    HostTime drawn{};
    while (!is_stop_requested() && !content.is_finished()) {
        const auto events = window_.poll_events();
        host_.take(events);
        const FrameTarget now = window_.frame();
        const bool has_changed = !events.empty() || host_.has_waiting() ||
                                 window_.pointer() != pointer || now.width != target.width ||
                                 now.height != target.height;
        pointer = window_.pointer();
        target = now;
        frames_due = has_changed ? kFramesAfterInput : frames_due;
        if (window_.should_close()) {
            if (content.may_close()) {
                return;
            }
            window_.stay_open();
            frames_due = kFramesAfterInput;
        }
        const HostTime at = HostClock::now();
        if (frames_due == 0 && !content.is_moving() && at - drawn < kAtLeast) {
            sleep_until(at + kRest);
            continue;
        }
        frames_due = frames_due > 0 ? frames_due - 1 : 0;
        drawn = at;
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
        glClearColor(0.07F, 0.08F, 0.12F, 1.0F);
        glClear(GL_COLOR_BUFFER_BIT);
        const float scale = pane_scale(target.width, target.height, window_.content_scale());
        host_.draw(target, scale, pointer, [&](const PaneFrame& frame) { content.draw(frame); });
        take_title(content.title());
        window_.present();
    }
}

void PaneWindow::take_title(std::string title) {
    if (!title.empty() && title != title_) {
        title_ = std::move(title);
        window_.set_title(title_);
    }
}

}  // namespace raks::render
