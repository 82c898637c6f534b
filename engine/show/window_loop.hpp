#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/key.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/show/picture.hpp"
#include "engine/show/show.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/window.hpp"
#include "render/overlay/overlay.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::engine {

/// One picture that a window's content draws into.
struct WindowPicture {
    render::Renderer& renderer;
    render::Scene& scene;  ///< theme, camera and view are the loop's; the rest is the content's
    render::FrameTarget target;
    HostTime seen_at;  ///< when it will be on the screen: about one refresh from now
};

/// What a window shows: the stage, a clip, a dance that is being written. Threads: main.
class WindowContent {
 public:
    virtual ~WindowContent() = default;

    /// A key before the table of actions gets it. True: it was the content's own.
    virtual bool handle(const KeyEvent& /*key*/) { return false; }
    /// Lines of help for keys of its own.
    [[nodiscard]] virtual std::vector<render::HelpRow> own_keys() const { return {}; }

    /// Time went by since the last picture.
    virtual void advance(double seconds) = 0;
    /// Draws one picture, and fills in what lies over it: the text must live until the next call.
    virtual void draw(const WindowPicture& picture, render::OverlayState& overlay) = 0;
    /// Nothing more is to be shown.
    [[nodiscard]] virtual bool is_finished() const = 0;

    /// A camera of the presets as it must stand for this content.
    [[nodiscard]] virtual render::Camera framed(render::Camera preset) const { return preset; }
};

/// The cards over the picture (OverlayView); `none`: this content has none to show.
enum class Cards : std::uint8_t { none, hidden, shown };

struct WindowLoopOptions {
    Cards cards = Cards::none;
    SayLine say = [](const std::string&) {};  ///< gets lines for people
    /// Asked after each picture: true ends the loop, for example when a signal came.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// Why a loop ended.
enum class WindowEnd : std::uint8_t {
    finished,  ///< the content is
    quit,      ///< the window was closed, a key or another input said so, or a stop was requested
};

/// The loop of a window: events, camera, list of keys, message line, screenshots, pace of the
/// pictures. One lives as long as its window; content after content runs in it.
///
///     auto loop = WindowLoop::create(std::move(window), look, {.say = say, ...});
///     ActionDispatcher actions(say);      // what the content does is bound to it first
///     loop->run(content, actions);
///
/// Threads: main. Real-time: no.
class WindowLoop {
 public:
    /// The window's OpenGL context must be current. Errors: the driver refuses.
    [[nodiscard]] static Expected<WindowLoop> create(render::Window window,
                                                     const Look& look,
                                                     WindowLoopOptions options);

    /// Shows `content` until it is finished or the end is asked for. Adds to `actions` what every
    /// window does: camera, theme, cards, full screen, screenshot, help, quit.
    [[nodiscard]] WindowEnd run(WindowContent& content, ActionDispatcher& actions);

    /// A line for people, and for a while over the picture.
    void say(const std::string& line);
    /// A line for people, or empty: what the quality became and why.
    [[nodiscard]] std::string_view notice() const noexcept { return drawing_.renderer.notice(); }
    /// What is drawn, for contents that change it between two pictures.
    [[nodiscard]] render::Scene& scene() noexcept { return scene_; }

 private:
    WindowLoop(render::Window window, const Look& look, Drawing drawing, WindowLoopOptions options);

    void bind(WindowContent& content, ActionDispatcher& actions);
    void bind_window(ActionDispatcher& actions);
    void handle_events(WindowContent& content, const ActionDispatcher& actions);
    void handle(const KeyEvent& key, WindowContent& content, const ActionDispatcher& actions);
    void draw(WindowContent& content);
    void draw_overlay(render::OverlayState overlay, const render::FrameTarget& target);
    void count_picture();
    void save_screenshot();

    void toggle_help(const WindowContent& content, const ActionDispatcher& actions);
    void toggle_overlay();
    void go_to_next_camera(const WindowContent& content);
    void go_to_next_theme();
    [[nodiscard]] render::Camera preset(const WindowContent& content) const;

    // The window before what is drawn in it: its context must live longer.
    render::Window window_;
    Drawing drawing_;
    WindowLoopOptions options_;
    render::Scene scene_;
    std::string camera_name_;
    render::OverlayView overlay_view_;
    std::vector<render::HelpRow> help_;  // none: hidden
    bool wants_screenshot_ = false;
    bool wants_to_quit_ = false;
    std::string message_;
    HostTime message_until_{};
    HostTime last_picture_{};
    double fps_ = 0.0;
};

/// The list of keys: the content's own, then those of the table that `actions` does and that the
/// content leaves to it.
[[nodiscard]] std::vector<render::HelpRow> help_rows(std::vector<render::HelpRow> own,
                                                     const ActionDispatcher& actions);

}  // namespace raks::engine
