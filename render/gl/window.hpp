#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/expected.hpp"
#include "base/key.hpp"
#include "base/time.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/mouse_button.hpp"
#include "render/gl/window_place.hpp"

namespace raks::render {

/// When the next picture is due. Pure arithmetic over HostTime, so that a test can drive it.
///
/// Where vertical sync paces the loop, the limiter allows 10 % more pictures than the monitor
/// shows, so that the two do not wait for each other; it then acts only when the sync is ignored
/// (Xvfb, hidden windows). Threads: one.
class FrameLimiter {
 public:
    /// `exact`: the limiter alone sets the rate. `behind_vsync`: it only catches a sync that is
    /// ignored.
    enum class Pace { exact, behind_vsync };

    /// `fps` > 0.
    FrameLimiter(double fps, Pace pace) noexcept
        : period_(nanos_from_seconds((pace == Pace::exact ? 1.0 : 0.9) / fps)) {}

    /// Called when a picture was handed over at `now`: returns until when to sleep. A late picture
    /// is not made up for: the next one is due a whole period after it.
    [[nodiscard]] HostTime next_due(HostTime now) noexcept {
        const HostTime due = due_ + period_;
        due_ = due < now ? now : due;
        return due_;
    }
    /// Shortest time between two pictures.
    [[nodiscard]] Nanos period() const noexcept { return period_; }

 private:
    Nanos period_;
    HostTime due_{};
};

/// Sleeps until `due` on CLOCK_MONOTONIC; returns at once when it has passed.
void sleep_until(HostTime due) noexcept;

/// A button went down or up at (x, y): framebuffer pixels, origin at the top left.
struct MouseButtonEvent {
    /// Which one changed.
    MouseButton button{};
    /// Pressed, or let go.
    bool is_down = false;
    /// From the left edge.
    float x = 0.0F;
    /// From the upper edge.
    float y = 0.0F;
    /// The second press of a double click (DoubleClick); the first one came before as it is.
    bool is_double = false;
};

/// The mouse moved by (dx, dy) pixels with `button` held: orbit, pan.
struct MouseDragEvent {
    /// The held button; the first of left, right, middle where several are.
    MouseButton button{};
    /// Whether a shift key is down.
    bool has_shift = false;
    /// Pixels to the right.
    float dx = 0.0F;
    /// Pixels downward.
    float dy = 0.0F;
    /// Where it is now, as of MouseButtonEvent.
    float x = 0.0F;
    /// As x.
    float y = 0.0F;
};

/// Where the pointer is: framebuffer pixels, origin at the top left; outside of the window, too.
struct PointerPlace {
    /// From the left edge.
    float x = 0.0F;
    /// From the upper edge.
    float y = 0.0F;
    friend bool operator==(const PointerPlace&, const PointerPlace&) = default;
};

/// Steps of the wheel; up and right are positive.
struct ScrollEvent {
    /// Sideways.
    float dx = 0.0F;
    /// Of an ordinary wheel.
    float dy = 0.0F;
};

/// Files were dropped on the window.
struct DropEvent {
    /// As the system gave them.
    std::vector<std::string> paths;
};

using WindowEvent =
    std::variant<KeyEvent, MouseButtonEvent, MouseDragEvent, ScrollEvent, DropEvent>;

/// How a window is opened.
struct WindowOptions {
    /// UTF-8.
    std::string title = "Raks";
    int width = 1280;  ///< of a window that is not full screen, in screen coordinates
    /// As width.
    int height = 720;
    /// Where it was when it was closed last: opens there, with that size in place of the one above
    /// (opening_place).
    std::optional<WindowPlace> place = std::nullopt;
    /// From the start; `toggle_fullscreen` changes it.
    bool is_fullscreen = false;
    bool is_transparent = false;  ///< what is drawn with alpha 0 shows the desktop (compositor)
    bool is_borderless = false;   ///< without title and frame; `toggle_border` changes it
    bool is_on_top = false;       ///< over all other windows; `toggle_on_top` changes it
    /// Off for tests that draw into a hidden window.
    bool is_visible = true;
    int samples = 0;       ///< anti-aliasing of the window's own framebuffer
    double max_fps = 0.0;  ///< pictures a second; 0: the monitor's rate, or 60 when it tells none
    /// Whether the caller asks why_lost(), and ends by itself when the display goes away or the
    /// driver has lost the context. Else Xlib ends the process, and of the driver nobody asks.
    bool outlives_loss = false;
    /// Tells in the driver's place whether it has lost the context (glGetGraphicsResetStatus); for
    /// tests, as no driver loses it when asked to. Null: the driver.
    unsigned (*reset_status)() = nullptr;
    /// What to do where no window can be opened: the end of create()'s errors.
    std::string otherwise = "use --headless, or `raks render`";
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
    /// Errors: no display ("no display: DISPLAY is not set; " and what to do), no OpenGL 3.3.
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
    /// The person or the system asked for the end, request_close() was called, or why_lost().
    [[nodiscard]] bool should_close() const;
    /// Makes `should_close` true.
    void request_close();
    /// Makes `should_close` false: something is to be asked first.
    void stay_open();
    /// Why nothing can be shown any more, for people: the display is gone, or the driver has lost
    /// the context; both where WindowOptions::outlives_loss. Empty: it can. From then on there are
    /// no events, frame() is 0 x 0, and whoever has the window ends.
    [[nodiscard]] std::string_view why_lost() const;
    /// Where the pointer was when events were polled last.
    [[nodiscard]] PointerPlace pointer() const;

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

    /// Full screen on the monitor that holds most of the window, or back to where it was. Over a
    /// full screen the pointer is hidden while it rests.
    void toggle_fullscreen();
    /// Whether it fills a monitor.
    [[nodiscard]] bool is_fullscreen() const;
    /// Full screen on the monitor that follows in the system's order the one that the window is on.
    /// Returns its name; empty: there is no other one, and nothing has changed.
    [[nodiscard]] std::string go_to_next_monitor();
    /// Where it is; of a full screen where it was before. For WindowOptions::place. Nothing where
    /// why_lost().
    [[nodiscard]] std::optional<WindowPlace> place() const;
    /// Hides the pointer wherever it is over the window, or shows it again as usual.
    void show_pointer(bool is_shown);
    /// Takes title and frame away, or gives them back. Returns whether they are there now.
    bool toggle_border();
    /// Keeps the window over all others, or no more. Returns whether it does now.
    bool toggle_on_top();
    /// Whether the desktop shows through (asked for, and a compositor runs).
    [[nodiscard]] bool is_transparent() const;
    /// UTF-8.
    void set_title(const std::string& title);

 private:
    struct State;
    void follow_monitor();
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace raks::render
