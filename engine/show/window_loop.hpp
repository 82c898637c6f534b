#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/key.hpp"
#include "base/time.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/show/avatar_change.hpp"
#include "engine/show/clip_performance.hpp"
#include "engine/show/help_list.hpp"
#include "engine/show/list_panel.hpp"
#include "engine/show/picture.hpp"
#include "engine/show/show.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/window.hpp"
#include "render/overlay/overlay.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::engine {

/// What a content needs to draw one picture.
struct WindowPicture {
    render::Renderer& renderer;  ///< draws the scene into the target
    DancerBodies& bodies;        ///< what its dancers wear
    render::Scene& scene;        ///< theme and view are the loop's; the rest is the content's
    CameraChoice camera;         ///< who moves the scene's camera
    render::FrameTarget target;  ///< where to draw; its size is that of the window
    /// Host time at which the picture will be visible: about one refresh from now.
    HostTime seen_at;
};

/// What the window looks at, for pictures that go elsewhere.
struct WindowView {
    Drawing& drawing;            ///< renderer, bodies, overlay
    const render::Scene& scene;  ///< as the window has it now
    CameraChoice camera;         ///< who moves the scene's camera
    /// What is performed in the dance's place; null: the dance is seen.
    ClipPerformance* performance = nullptr;
};

/// What a window shows: the stage, a clip, a dance that is being written. The loop calls it.
/// Threads: main.
class WindowContent {
 public:
    virtual ~WindowContent() = default;  ///< contents are owned elsewhere

    /// Gets each key before the table of actions does. True: the content has used it.
    virtual bool handle(const KeyEvent& /*key*/) { return false; }
    /// Called when something of the overlay is clicked, and while it is dragged; the list of keys
    /// is the loop's own. `share`: of the file, [0, 1], where the position is meant.
    virtual void use(render::OverlayControl /*control*/, double /*share*/) {}
    /// Files were dropped on the window. False: the loop takes models among them as avatars, and
    /// says of others that it does not.
    virtual bool take_dropped(const std::vector<std::string>& /*paths*/) { return false; }
    /// Models that were asked for cannot be worn. True: the content makes something else of them;
    /// false: the loop says why.
    virtual bool take_refused(const Error& /*why*/) { return false; }
    /// Help lines of the keys that handle() uses.
    [[nodiscard]] virtual std::vector<render::HelpRow> own_keys() const { return {}; }

    /// Moves on by the time since the last picture, in seconds.
    virtual void advance(double seconds) = 0;
    /// Draws what goes elsewhere than into the window; called before each of its pictures, also
    /// while it is minimized.
    virtual void draw_elsewhere(const WindowView& /*view*/) {}
    /// Draws one picture and fills in the overlay, whose texts must stay valid until the next call.
    virtual void draw(const WindowPicture& picture, render::OverlayState& overlay) = 0;
    /// True when there is nothing more to show: the loop ends.
    [[nodiscard]] virtual bool is_finished() const = 0;

    /// Whether the avatar is seen in it: then people can change it.
    [[nodiscard]] virtual bool has_avatar() const { return true; }

    /// Whether a director can film it: then kDirector is one of the cameras.
    [[nodiscard]] virtual bool has_director() const { return false; }

    /// A preset camera, moved to where it must stand for this content.
    [[nodiscard]] virtual render::Camera framed(render::Camera preset) const { return preset; }
};

/// Whether the information cards over the picture (OverlayView) are shown; `none`: the content has
/// none.
enum class Cards : std::uint8_t { none, hidden, shown };

/// How a loop reports and when it stops.
struct WindowLoopOptions {
    Cards cards = Cards::none;  ///< at the start; `none` also disables the key that toggles them
    SayLine say = [](const std::string&) {};  ///< gets lines for people
    /// Gets lines that few want to read, such as what an avatar's file lacks.
    SayLine say_detail = [](const std::string&) {};
    /// Asked after each picture; true ends the loop, for example after a signal.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// Why a loop has ended.
enum class WindowEnd : std::uint8_t {
    finished,  ///< the content has ended
    quit,      ///< the window was closed, an action asked for it, or a stop was requested
};

/// The loop of a window: events, camera, list of keys, message line, screenshots and pace of the
/// pictures. A loop lives as long as its window; one content after the other runs in it.
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

    /// Shows `content` until it is finished or the end is asked for. Registers with `actions` what
    /// every window does: camera, theme, cards, full screen, screenshot, help, quit.
    [[nodiscard]] WindowEnd run(WindowContent& content, ActionDispatcher& actions);

    /// Between two contents: whether the end is asked for already. What else people ask for
    /// meanwhile waits for the next content.
    [[nodiscard]] bool is_end_wanted();

    /// Models are worn by the dancers in turn as soon as they are loaded; at most kMostAvatars.
    void wear(std::vector<std::string> models);
    /// What mannequins among the dancers wear as soon as it is made.
    void dress(render::Costume costume) { avatar_change_.dress(costume); }
    /// Opens a list over the picture at a page of it; closes it where that page is open already.
    /// `offer` is asked for only where it is opened.
    void toggle_list(std::string_view name,
                     std::size_t page,
                     const std::function<std::unique_ptr<ListOffer>()>& offer);
    /// The list over the picture.
    [[nodiscard]] ListPanel& list() noexcept { return list_; }

    /// Passes a line for people on, and shows it over the picture for 4 s.
    void say(const std::string& line);
    /// Shows a line over the picture alone, for 4 s.
    void show(const std::string& line);
    /// A line for people when the renderer has changed its quality, with the reason; else empty.
    [[nodiscard]] std::string_view notice() const noexcept { return drawing_.renderer.notice(); }
    /// Whether what is transparent shows what lies behind the window: a compositor runs.
    [[nodiscard]] bool is_transparent() const { return window_.is_transparent(); }
    /// Why nothing can be shown any more; empty: it can (render::Window::why_lost).
    [[nodiscard]] std::string_view why_lost() const { return window_.why_lost(); }
    /// Where the window is (render::Window::place).
    [[nodiscard]] std::optional<render::WindowPlace> place() const { return window_.place(); }
    /// The avatars that a person has chosen in the window and that are worn; empty: none.
    [[nodiscard]] const std::vector<std::string>& chosen_avatars() const noexcept {
        return chosen_avatars_;
    }
    /// The avatar that is worn first, or was asked for last: a file, or kMannequinName.
    [[nodiscard]] const std::string& avatar_name() const noexcept { return avatar_name_; }
    /// The camera's preset, or the director.
    [[nodiscard]] const std::string& camera_name() const noexcept { return camera_name_; }
    /// Looks through this preset, or leaves the camera to the director.
    void set_camera(std::string name, const WindowContent& content);
    /// The bodies that are seen, for whom dances are solved.
    [[nodiscard]] std::vector<motion::Skeleton> dance_bodies() const {
        return drawing_.bodies.dance_bodies();
    }
    /// The scene that is drawn; contents may change it between two pictures.
    [[nodiscard]] render::Scene& scene() noexcept { return scene_; }

 private:
    WindowLoop(render::Window window, const Look& look, Drawing drawing, WindowLoopOptions options);

    void bind(WindowContent& content, ActionDispatcher& actions);
    void bind_window(ActionDispatcher& actions);
    void handle_events(WindowContent& content, const ActionDispatcher& actions);
    void handle(const render::WindowEvent& event,
                WindowContent& content,
                const ActionDispatcher& actions);
    void handle(const KeyEvent& key, WindowContent& content, const ActionDispatcher& actions);
    void handle(const render::MouseButtonEvent& button,
                WindowContent& content,
                const ActionDispatcher& actions);
    void handle(const render::MouseDragEvent& drag, WindowContent& content);
    void handle(const render::DropEvent& drop, const WindowContent& content);
    void draw(WindowContent& content);
    void draw_overlay(render::OverlayState overlay, const render::FrameTarget& target);
    void count_picture();
    void save_screenshot();

    void click_panel(const render::OverlaySpot& spot,
                     WindowContent& content,
                     const ActionDispatcher& actions);
    void toggle_help(const WindowContent& content, const ActionDispatcher& actions);
    void toggle_overlay();
    void toggle_clean();
    void end_clean();
    void go_to_next_camera(const WindowContent& content);
    void look_from(std::size_t direction, const WindowContent& content);
    void let_go_of_camera(const WindowContent& content);
    void go_to_next_theme();
    void go_to_next_backdrop();
    void go_to_next_monitor();
    void go_to_next_avatar();
    [[nodiscard]] Expected<void> wear_named(const std::string& name);
    [[nodiscard]] Expected<void> look_through(const std::string& name,
                                              const WindowContent& content);
    void change_avatar(WindowContent& content);
    void say_avatar(const LoadedAvatar& avatar);
    [[nodiscard]] render::Camera preset(const WindowContent& content) const;

    // The window before what is drawn in it: its context must live longer.
    render::Window window_;
    Drawing drawing_;
    WindowLoopOptions options_;
    render::Scene scene_;
    std::string camera_name_;
    bool is_camera_held_ = false;  // by a person's hand
    bool is_from_above_ = false;   // steeper than the preset, which shows a dancer's face
    std::string avatar_name_;      // as LoadedAvatar::name, of the first of those asked for last
    AvatarChange avatar_change_;
    bool lacks_partners_;  // until the first picture is seen
    std::vector<std::string> chosen_avatars_;
    render::OverlayView overlay_view_;
    bool is_clean_ = false;  // nothing but the picture, whatever else is to be shown
    HelpList help_;
    ListPanel list_;
    render::OverlayControls controls_;  // of the last picture
    bool is_position_held_ = false;     // the bar is being dragged
    bool is_click_taken_ = false;       // what is dragged is not the camera
    bool has_dragged_ = false;          // since the last press
    float pointer_x_ = 0.0F;            // while a button is held, in pixels
    bool wants_screenshot_ = false;
    bool wants_to_quit_ = false;
    std::vector<render::WindowEvent> waiting_;  // came between two contents
    std::string message_;
    HostTime message_until_{};
    HostTime last_picture_{};
    double fps_ = 0.0;
};

}  // namespace raks::engine
