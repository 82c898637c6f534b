#pragma once

#include <memory>
#include <span>
#include <string>

#include "base/expected.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/window_event.hpp"

namespace raks::render {

/// How a window is opened.
struct WindowOptions {
    /// UTF-8.
    std::string title = "Raks";
    int width = 1280;  ///< of a window that is not full screen, in screen coordinates
    /// As width.
    int height = 720;
    /// From the start; `toggle_fullscreen` changes it.
    bool is_fullscreen = false;
    bool is_transparent = false;  ///< what is drawn with alpha 0 shows the desktop (compositor)
    /// Off for tests that draw into a hidden window.
    bool is_visible = true;
    int samples = 0;       ///< anti-aliasing of the window's own framebuffer
    double max_fps = 0.0;  ///< pictures a second; 0: the monitor's rate, or 60 when it tells none
};

/// A window with an OpenGL 3.3 core context, current on the thread that made it.
///
///     while (!window.should_close()) {
///         for (const WindowEvent& event : window.poll_events()) { ... }
///         renderer.draw(scene, pose, window.frame());
///         window.present();
///     }
///
/// Threads: the main thread alone (GLFW's rule). Real-time: no.
class Window {
 public:
    /// Errors: no display ("no display: set DISPLAY, or use --headless"), no OpenGL 3.3.
    [[nodiscard]] static Expected<Window> create(const WindowOptions& options);
    /// The source may only be destroyed or assigned to.
    Window(Window&&) noexcept;
    /// As the constructor.
    Window& operator=(Window&&) noexcept;
    /// Closes the window; what was made in its context must be gone.
    ~Window();

    /// Lets the system deliver, and returns what came since the last call, oldest first. Valid
    /// until the next call.
    [[nodiscard]] std::span<const WindowEvent> poll_events();
    /// The person or the system asked for the end, or request_close() was called.
    [[nodiscard]] bool should_close() const;
    /// Makes `should_close` true.
    void request_close();

    /// Where to draw: all of the window's own framebuffer, in pixels; changes with the window.
    /// 0 x 0 while minimised: draw nothing then. `read_rgba(window.frame(), rgba)` before
    /// present() reads back what was drawn.
    [[nodiscard]] FrameTarget frame() const;
    /// Size of text on this monitor: 1 on an ordinary one, 2 on a fine one.
    [[nodiscard]] float content_scale() const;
    /// The monitor that the window is on, in pictures a second; 60 when it tells none.
    [[nodiscard]] double refresh_rate() const;

    /// Shows what was drawn and waits (asleep, never spinning) until the next picture is due: by
    /// vertical sync where the system keeps it, else by a clock.
    void present();

    /// Full screen on the monitor that holds most of the window, or back to where it was.
    void toggle_fullscreen();
    /// Whether it fills a monitor.
    [[nodiscard]] bool is_fullscreen() const;
    /// Whether the desktop shows through (asked for, and a compositor runs).
    [[nodiscard]] bool is_transparent() const;
    /// UTF-8.
    void set_title(const std::string& title);

 private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace raks::render
