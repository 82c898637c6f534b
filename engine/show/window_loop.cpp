#include "engine/show/window_loop.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/expected.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "engine/control/action_table.hpp"
#include "engine/setup/user_folders.hpp"
#include "engine/show/avatar_files.hpp"
#include "engine/show/themes.hpp"
#include "render/avatar/avatar.hpp"
#include "render/gl/frame_target.hpp"
#include "render/gl/window.hpp"
#include "render/scene/camera.hpp"
#include "render/video/png.hpp"
#include "render/video/straight_alpha.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// How long a message stays over the picture.
constexpr Nanos kMessageTime = std::chrono::seconds(4);
// Weight of the newest picture in the running mean of the picture rate: about the last 20 count.
constexpr double kFpsShare = 0.05;

// The name that follows in the list, cyclically; the first for a name that is not in it.
std::string_view name_after(std::string_view name, std::span<const std::string_view> names) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() || at + 1 == names.end() ? names.front() : *(at + 1);
}

/// Writes what was drawn to `frame` as a PNG file. An OpenGL context must be current. Errors: the
/// frame cannot be read back, the file cannot be written.
Expected<void> write_screenshot(const std::filesystem::path& path,
                                const render::FrameTarget& frame) {
    // Four bytes a pixel, rows from the top as PNG has them.
    std::vector<std::uint8_t> rgba(static_cast<std::size_t>(frame.width) *
                                   static_cast<std::size_t>(frame.height) * 4);
    if (auto read = render::read_rgba(frame, rgba); !read) {
        return read;
    }
    render::make_straight(rgba);
    return render::write_png(path, frame.width, frame.height, rgba);
}

}  // namespace

Expected<WindowLoop> WindowLoop::create(render::Window window,
                                        const Look& look,
                                        WindowLoopOptions options) {
    auto drawing = create_drawing(look);
    if (!drawing) {
        return fail(drawing.error());
    }
    return WindowLoop(std::move(window), look, std::move(*drawing), std::move(options));
}

WindowLoop::WindowLoop(render::Window window,
                       const Look& look,
                       Drawing drawing,
                       WindowLoopOptions options)
    : window_(std::move(window)),
      drawing_(std::move(drawing)),
      options_(std::move(options)),
      scene_(look.scene),
      camera_name_(look.camera),
      avatar_name_(look.avatars.empty() ? kMannequinName : look.avatars.front().name),
      avatar_change_(look.avatars, look.costume, look.most_image_bytes),
      lacks_partners_(look.partners == Partners::first),
      overlay_view_(options_.cards == Cards::shown ? render::OverlayView::shown
                                                   : render::OverlayView::hidden) {}

WindowEnd WindowLoop::run(WindowContent& content, ActionDispatcher& actions) {
    // Bound at each run: the handlers refer to this content.
    bind(content, actions);
    HostTime last = HostClock::now();
    for (;;) {
        handle_events(content, actions);
        const HostTime now = HostClock::now();
        // Time passes by the clock and not by pictures: a slow picture must not slow the content.
        content.advance(to_seconds(now - last));
        last = now;
        change_avatar(content);
        content.draw_elsewhere(
            {drawing_, scene_, {camera_name_, preset(content), is_camera_held_}, nullptr});
        draw(content);
        if (std::exchange(lacks_partners_, false)) {
            avatar_change_.add_partners();
        }
        // Checked after the picture, so that a screenshot asked for with the last key is still
        // taken.
        if (options_.is_stop_requested() || window_.should_close() || wants_to_quit_) {
            return WindowEnd::quit;
        }
        if (content.is_finished()) {
            return WindowEnd::finished;
        }
    }
}

bool WindowLoop::is_end_wanted() {
    for (const render::WindowEvent& event : window_.poll_events()) {
        const auto* const key = std::get_if<KeyEvent>(&event);
        const auto request = key != nullptr ? request_of(*key) : std::nullopt;
        wants_to_quit_ = wants_to_quit_ || (request && request->action == Action::quit);
        waiting_.push_back(event);
    }
    return options_.is_stop_requested() || window_.should_close() || wants_to_quit_;
}

// On the terminal and over the picture.
void WindowLoop::say(const std::string& line) {
    options_.say(line);
    show(line);
}

void WindowLoop::show(const std::string& line) {
    message_ = line;
    message_until_ = HostClock::now() + kMessageTime;
}

void WindowLoop::bind(WindowContent& content, ActionDispatcher& actions) {
    bind_window(actions);
    // These four depend on the content.
    actions.on(Action::toggle_help, [&](double) { toggle_help(content, actions); });
    actions.on(Action::next_camera, [&](double) { go_to_next_camera(content); });
    actions.on(Action::select_camera,
               [&](double number) { look_from(static_cast<std::size_t>(number) - 1, content); });
    actions.on(Action::reset_camera, [&](double) { let_go_of_camera(content); });
    actions.on_text(Action::next_camera, [this, &content](const std::string& name) {
        return look_through(name, content);
    });
    if (content.has_avatar()) {
        actions.on_text(Action::next_avatar,
                        [this](const std::string& name) { return wear_named(name); });
        actions.on(Action::next_avatar, [this](double) { go_to_next_avatar(); });
    }
}

void WindowLoop::bind_window(ActionDispatcher& actions) {
    actions.on(Action::next_theme, [this](double) { go_to_next_theme(); });
    actions.on_text(Action::next_theme, [this](const std::string& name) -> Expected<void> {
        const auto theme = find_theme(name);
        if (!theme) {
            return fail(theme.error());
        }
        scene_.theme = *theme;
        return {};
    });
    actions.on(Action::next_backdrop, [this](double) { go_to_next_backdrop(); });
    actions.on_text(Action::next_backdrop, [this](const std::string& text) {
        // The table has checked it.
        if (const auto backdrop = parse_backdrop(text)) {
            set_backdrop(scene_, *backdrop);
        }
        return Expected<void>();
    });
    actions.on(Action::clean_picture, [this](double) { toggle_clean(); });
    actions.on(Action::next_monitor, [this](double) { go_to_next_monitor(); });
    actions.on(Action::toggle_fullscreen, [this](double) { window_.toggle_fullscreen(); });
    actions.on(Action::toggle_border, [this](double) {
        say(window_.toggle_border() ? "the window has its frame"
                                    : "the window has no frame (W: give it back)");
    });
    actions.on(Action::toggle_on_top, [this](double) {
        say(window_.toggle_on_top() ? "the window stays over all others (Y: no more)"
                                    : "other windows may lie over this one");
    });
    actions.on(Action::screenshot, [this](double) { wants_screenshot_ = true; });
    actions.on(Action::quit, [this](double) { wants_to_quit_ = true; });
    // Without cards there is nothing to toggle, and the help panel must not list the key.
    if (options_.cards != Cards::none) {
        actions.on(Action::toggle_overlay, [this](double) { toggle_overlay(); });
    }
}

void WindowLoop::draw(WindowContent& content) {
    const render::FrameTarget target = window_.frame();
    if (target.width > 0 && target.height > 0) {  // else it is minimized
        // A picture is visible one refresh after it is handed over; the content draws that moment.
        const Nanos until_seen = nanos_from_seconds(1.0 / window_.refresh_rate());
        render::OverlayState overlay;
        content.draw({.renderer = drawing_.renderer,
                      .bodies = drawing_.bodies,
                      .scene = scene_,
                      .camera = {camera_name_, preset(content), is_camera_held_},
                      .target = target,
                      .seen_at = HostClock::now() + until_seen},
                     overlay);
        draw_overlay(overlay, target);
    }
    // After drawing and before present(): the frame still holds this picture.
    if (std::exchange(wants_screenshot_, false)) {
        save_screenshot();
    }
    // Waits for the screen's refresh, which paces the loop.
    window_.present();
    count_picture();
}

// The loop's own parts of the overlay: rate, help and message.
void WindowLoop::draw_overlay(render::OverlayState overlay, const render::FrameTarget& target) {
    if (is_clean_) {
        controls_ = {};
        return;
    }
    overlay.fps = fps_;
    help_.show(overlay);
    overlay.list = list_.look();
    if (HostClock::now() < message_until_) {
        overlay.message = message_;
    }
    controls_ = drawing_.overlay.draw(overlay, overlay_view_, target, window_.content_scale());
    help_.set_pages(controls_.help_pages);
}

// Exponential mean: single late pictures do not make the number flicker.
void WindowLoop::count_picture() {
    const HostTime now = HostClock::now();
    const double seconds = to_seconds(now - last_picture_);
    last_picture_ = now;
    // At least 1 ms, so that the first pictures do not divide by nothing.
    fps_ += kFpsShare * (1.0 / std::max(seconds, 1e-3) - fps_);
}

void WindowLoop::save_screenshot() {
    const std::filesystem::path path = dated_file(pictures_folder(), ".png");
    const auto done = write_screenshot(path, window_.frame());
    say(done ? "screenshot saved: " + path.string() : done.error().message);
}

// The list is made when it is opened: what the actions handle depends on the content.
void WindowLoop::toggle_help(const WindowContent& content, const ActionDispatcher& actions) {
    end_clean();
    list_.close();
    help_.turn(help_rows(content.own_keys(), actions));
    // The help lies on the cards' layer and would stay invisible while that is hidden.
    if (options_.cards != Cards::none) {
        overlay_view_ = render::OverlayView::shown;
    }
}

void WindowLoop::toggle_overlay() {
    const bool is_bare = overlay_view_ == render::OverlayView::hidden;
    overlay_view_ = is_bare ? render::OverlayView::shown : render::OverlayView::hidden;
    // Hiding everything closes the help, too.
    help_.close();
    end_clean();
}

void WindowLoop::end_clean() {
    if (std::exchange(is_clean_, false)) {
        window_.show_pointer(true);
    }
}

void WindowLoop::toggle_clean() {
    is_clean_ = !is_clean_;
    help_.close();
    list_.close();
    window_.show_pointer(!is_clean_);
}

void WindowLoop::go_to_next_monitor() {
    const std::string name = window_.go_to_next_monitor();
    say(name.empty() ? "there is no other monitor" : "full screen on " + printable(name));
}

void WindowLoop::set_camera(std::string name, const WindowContent& content) {
    camera_name_ = std::move(name);
    is_from_above_ = false;
    let_go_of_camera(content);
}

void WindowLoop::toggle_list(std::string_view name,
                             std::size_t page,
                             const std::function<std::unique_ptr<ListOffer>()>& offer) {
    help_.close();
    end_clean();
    if (list_.name() == name && list_.page() == page) {
        list_.close();
    } else {
        list_.open(offer(), name, page);
    }
}

// The preset is applied anew, also after the mouse has moved the camera.
void WindowLoop::go_to_next_camera(const WindowContent& content) {
    std::vector<std::string_view> names;
    if (content.has_director()) {
        names.push_back(kDirector);
    }
    const auto presets = render::camera_names();
    names.insert(names.end(), presets.begin(), presets.end());
    // Where there is no director, the first preset has stood in for it.
    const bool is_stand_in = camera_name_ == kDirector && !content.has_director();
    camera_name_ = name_after(is_stand_in ? presets.front() : camera_name_, names);
    is_from_above_ = false;
    let_go_of_camera(content);
    say("camera " + camera_name_);
}

Expected<void> WindowLoop::look_through(const std::string& name, const WindowContent& content) {
    const std::span<const std::string_view> presets = render::camera_names();
    std::vector<std::string_view> names(presets.begin(), presets.end());
    if (content.has_director()) {
        names.push_back(kDirector);
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        return fail(unknown_name("camera", name, names));
    }
    set_camera(name, content);
    return {};
}

// In the order of the action's keys.
void WindowLoop::look_from(std::size_t direction, const WindowContent& content) {
    constexpr std::array<std::string_view, 4> kNames = {"front", "side", "back", "top"};
    camera_name_ = kNames[direction];
    is_from_above_ = camera_name_ == "top";
    let_go_of_camera(content);
    say("camera " + camera_name_);
}

void WindowLoop::let_go_of_camera(const WindowContent& content) {
    is_camera_held_ = false;
    scene_.camera = preset(content);
}

void WindowLoop::go_to_next_theme() {
    std::vector<std::string> lines;
    scene_.theme = &theme_after(scene_.theme->name, lines);
    for (const std::string& line : lines) {
        say(line);
    }
    say("theme " + scene_.theme->name);
}

void WindowLoop::go_to_next_backdrop() {
    switch (scene_.backdrop) {
        case render::Backdrop::stage:
            scene_.backdrop = render::Backdrop::transparent;
            say(window_.is_transparent()
                    ? "backdrop: transparent"
                    : "backdrop: transparent, but no compositor runs: black is seen");
            return;
        case render::Backdrop::transparent:
            scene_.backdrop = render::Backdrop::key;
            say(fmt::format("backdrop: key colour #{:02x}{:02x}{:02x}",
                            scene_.key[0],
                            scene_.key[1],
                            scene_.key[2]));
            return;
        case render::Backdrop::key:
            scene_.backdrop = render::Backdrop::stage;
            say("backdrop: stage");
            return;
    }
}

// The mannequin, then the person's own in the order of their names.
void WindowLoop::go_to_next_avatar() {
    const auto files = list_avatars();
    if (!files) {
        say(files.error().message);
        return;
    }
    if (files->empty() && avatar_name_ == kMannequinName) {
        say("no other avatar: drop a model on the window, or put .vrm or .glb files into " +
            printable(user_avatars_path().string()));
        return;
    }
    std::vector<std::string> names = {std::string(kMannequinName)};
    std::transform(files->begin(),
                   files->end(),
                   std::back_inserter(names),
                   [](const std::filesystem::path& file) { return file.string(); });
    const std::vector<std::string_view> views(names.begin(), names.end());
    wear({std::string(name_after(avatar_name_, views))});
}

// By its name alone, which is no path: others may ask for it.
Expected<void> WindowLoop::wear_named(const std::string& name) {
    std::vector<std::string_view> known = {kMannequinName};
    const auto files = list_avatars();
    std::vector<std::string> stems;
    for (const std::filesystem::path& file :
         files ? *files : std::vector<std::filesystem::path>()) {
        if (file.filename() == name || file.stem() == name) {
            wear({file.string()});
            return {};
        }
        stems.push_back(file.stem().string());
    }
    if (name == kMannequinName) {
        wear({name});
        return {};
    }
    known.insert(known.end(), stems.begin(), stems.end());
    return fail(unknown_name("avatar", name, known));
}

void WindowLoop::wear(std::vector<std::string> names) {
    avatar_name_ = names.front();
    const std::string first = printable(std::filesystem::path(avatar_name_).filename().string());
    show(names.size() == 1 ? "loading " + first
                           : fmt::format("loading {} and {} more", first, names.size() - 1));
    avatar_change_.ask(std::move(names));
}

// Before each picture: a part of the work, if there is any. The camera moves with the size, so that
// a person's own place is kept.
void WindowLoop::change_avatar(WindowContent& content) {
    const float size_before = drawing_.bodies.size();
    auto changed = avatar_change_.go_on(drawing_);
    if (!changed) {
        if (!content.take_refused(changed.error())) {
            say(changed.error().message);
        }
    } else if (!changed->empty()) {
        scene_.camera = camera_for(scene_.camera, drawing_.bodies.size() / size_before);
        chosen_avatars_.clear();
        for (const LoadedAvatar& avatar : *changed) {
            chosen_avatars_.push_back(avatar.name);
            say_avatar(avatar);
        }
    }
}

void WindowLoop::say_avatar(const LoadedAvatar& avatar) {
    say("avatar: " + (avatar.credit.empty() ? avatar.name : avatar.credit));
    for (const std::string& warning : avatar.warnings) {
        options_.say_detail(warning);
    }
}

// The content may move a preset: a formation needs more room than one dancer.
render::Camera WindowLoop::preset(const WindowContent& content) const {
    render::Camera camera = preset_of(camera_name_);
    if (is_from_above_) {
        camera.orbit(0.0F, render::Camera::kMaxPitch);
    }
    return content.framed(camera_for(camera, drawing_.bodies.size()));
}

}  // namespace raks::engine
