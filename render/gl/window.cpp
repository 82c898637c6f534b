#include "render/gl/window.hpp"

// OpenGL comes from epoxy, which other sources include.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

#include "base/thread_priority.hpp"
#include "render/gl/display_loss.hpp"
#include "render/gl/glfw_keys.hpp"
#include "render/gl/glfw_monitors.hpp"
#include "render/gl/glfw_opening.hpp"

namespace raks::render {

void sleep_until(HostTime due) noexcept {
    const auto ns = due.time_since_epoch().count();
    const timespec when{.tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000};
    // A signal ends the sleep early; the time is absolute, so sleeping again does not add to it.
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr) == EINTR) {
    }
}

namespace {

constexpr double kUsualRefreshRate = 60.0;  // where the monitor tells none: Xvfb says 0
// Over a full screen a pointer that rests for so long is hidden.
constexpr Nanos kPointerRest = std::chrono::seconds(2);

/// GLFW, alive while any window is.
class Glfw {
 public:
    Glfw() noexcept : is_up_(users++ > 0 || glfwInit() == GLFW_TRUE) {}
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
    ~Glfw() {
        // Of a display that is gone nothing may be asked any more.
        if (--users == 0 && is_up_ && !is_display_lost()) {
            glfwTerminate();
        }
    }
    [[nodiscard]] bool is_up() const noexcept { return is_up_; }

 private:
    static inline int users = 0;  // main thread alone
    bool is_up_;
};

/// GLFW's words for its last error.
std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "unknown reason";
}

constexpr std::array kMouseButtons = {
    std::pair{GLFW_MOUSE_BUTTON_LEFT, MouseButton::left},
    std::pair{GLFW_MOUSE_BUTTON_RIGHT, MouseButton::right},
    std::pair{GLFW_MOUSE_BUTTON_MIDDLE, MouseButton::middle},
};

/// A wish below the monitor's rate is kept by the clock. Fallback the vertical sync paces, and the
/// limiter stays behind it, unless the monitor tells no rate: then there may be no sync either.
FrameLimiter limiter_for(double max_fps, std::optional<double> refresh_rate) {
    const double monitor_fps = refresh_rate.value_or(kUsualRefreshRate);
    if (max_fps > 0.0 && max_fps < monitor_fps) {
        return {max_fps, FrameLimiter::Pace::exact};
    }
    return {monitor_fps,
            refresh_rate ? FrameLimiter::Pace::behind_vsync : FrameLimiter::Pace::exact};
}

}  // namespace

struct Window::State {
    Glfw glfw;
    GLFWwindow* handle = nullptr;
    double max_fps = 0.0;
    FrameLimiter limiter{kUsualRefreshRate, FrameLimiter::Pace::exact};
    Rectangle windowed;  // where it was before it went full screen

    // Callbacks fill `arriving`; `poll_events` swaps it with `delivered`, which the caller reads.
    std::vector<WindowEvent> arriving;
    std::vector<WindowEvent> delivered;
    // GLFW tells repeats with the key but not with the character that follows it.
    bool is_last_key_a_repeat = false;
    std::array<bool, kMouseButtons.size()> is_held{};
    double mouse_x = 0.0;
    double mouse_y = 0.0;
    HostTime moved_at{};  // when the pointer moved or a button changed
    bool is_pointer_wanted = true;
    bool is_pointer_hidden = false;
    DoubleClick double_click;
    unsigned (*reset_status)() = nullptr;  // null: the driver cannot tell
    bool has_lost_context = false;
    // Kept: asking the system for each picture costs a round trip to the display's server, and
    // GLFW does not survive one whose answer never comes.
    std::optional<double> refresh_rate;
    bool has_moved = false;  // since the rate was asked for

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (handle != nullptr && !is_display_lost()) {
            glfwDestroyWindow(handle);
        }
    }

    [[nodiscard]] static State* self(GLFWwindow* window) {
        return static_cast<State*>(glfwGetWindowUserPointer(window));
    }
    void listen();
    void on_key(int glfw_key, int action, int modifiers);
    void on_character(unsigned int codepoint);
    void on_button(int button, int action);
    void on_mouse(double x, double y);
    void show_or_hide_pointer();
    void fill(GLFWmonitor* monitor);
    void follow_monitor();
    [[nodiscard]] bool is_lost() const noexcept { return has_lost_context || is_display_lost(); }
    [[nodiscard]] float pixels_per_unit() const;
    [[nodiscard]] bool is_key_down(int key) const { return glfwGetKey(handle, key) == GLFW_PRESS; }
    [[nodiscard]] bool has_shift() const {
        return is_key_down(GLFW_KEY_LEFT_SHIFT) || is_key_down(GLFW_KEY_RIGHT_SHIFT);
    }
};

/// Callbacks find this object through the window's user pointer: it must not move from here on,
/// which is why Window holds it by pointer.
void Window::State::listen() {
    glfwSetWindowUserPointer(handle, this);
    glfwSetKeyCallback(handle, [](GLFWwindow* window, int key, int, int action, int modifiers) {
        self(window)->on_key(key, action, modifiers);
    });
    glfwSetCharCallback(handle, [](GLFWwindow* window, unsigned int codepoint) {
        self(window)->on_character(codepoint);
    });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* window, int button, int action, int) {
        self(window)->on_button(button, action);
    });
    glfwSetCursorPosCallback(
        handle, [](GLFWwindow* window, double x, double y) { self(window)->on_mouse(x, y); });
    glfwSetScrollCallback(handle, [](GLFWwindow* window, double dx, double dy) {
        self(window)->arriving.emplace_back(
            ScrollEvent{static_cast<float>(dx), static_cast<float>(dy)});
    });
    glfwSetDropCallback(handle, [](GLFWwindow* window, int count, const char** paths) {
        self(window)->arriving.emplace_back(DropEvent{{paths, paths + count}});
    });
    const auto on_move = [](GLFWwindow* window, int, int) { self(window)->has_moved = true; };
    glfwSetWindowPosCallback(handle, on_move);
    glfwSetWindowSizeCallback(handle, on_move);
}

// Its rate is the pace from now on.
void Window::State::follow_monitor() {
    has_moved = false;
    const std::optional<double> now = refresh_rate_of(handle);
    if (now != refresh_rate) {
        refresh_rate = now;
        limiter = limiter_for(max_fps, refresh_rate);
    }
}

void Window::State::on_key(int glfw_key, int action, int modifiers) {
    if (action == GLFW_RELEASE) {
        return;
    }
    is_last_key_a_repeat = action == GLFW_REPEAT;
    // Other keys with a character arrive in on_character(), as the keyboard's layout has them.
    if (const auto key = named_key(glfw_key)) {
        arriving.emplace_back(KeyEvent{.key = *key,
                                       .has_shift = (modifiers & GLFW_MOD_SHIFT) != 0,
                                       .has_control = (modifiers & GLFW_MOD_CONTROL) != 0,
                                       .is_repeat = is_last_key_a_repeat});
    } else if ((modifiers & GLFW_MOD_CONTROL) != 0) {
        // No character follows: the key by its name on this keyboard.
        const char* const name = glfwGetKeyName(glfw_key, 0);
        if (name != nullptr && name[0] > ' ' && name[0] <= '~' && name[1] == '\0') {
            arriving.emplace_back(KeyEvent{.key = key_of(static_cast<char32_t>(name[0])),
                                           .has_shift = (modifiers & GLFW_MOD_SHIFT) != 0,
                                           .has_control = true,
                                           .is_repeat = is_last_key_a_repeat});
        }
    }
}

void Window::State::on_character(unsigned int codepoint) {
    if (codepoint == ' ') {
        return;  // came as a named key
    }
    // GLFW sends no character while Control is held.
    arriving.emplace_back(KeyEvent{.key = key_of(static_cast<char32_t>(codepoint)),
                                   .has_shift = has_shift(),
                                   .has_control = false,
                                   .is_repeat = is_last_key_a_repeat});
}

// Where it is wanted: shown where it moves, and in a window always.
void Window::State::show_or_hide_pointer() {
    const bool is_full = glfwGetWindowMonitor(handle) != nullptr;
    const bool is_resting = HostClock::now() - moved_at > kPointerRest;
    const bool hides = !is_pointer_wanted || (is_full && is_resting);
    if (hides != is_pointer_hidden) {
        is_pointer_hidden = hides;
        glfwSetInputMode(handle, GLFW_CURSOR, hides ? GLFW_CURSOR_HIDDEN : GLFW_CURSOR_NORMAL);
    }
}

void Window::State::on_button(int button, int action) {
    moved_at = HostClock::now();
    for (std::size_t i = 0; i < kMouseButtons.size(); ++i) {
        if (kMouseButtons[i].first == button) {
            // Screen coordinates become pixels: the caller compares them with what is drawn.
            is_held[i] = action == GLFW_PRESS;
            const float scale = pixels_per_unit();
            MouseButtonEvent event{.button = kMouseButtons[i].second,
                                   .is_down = is_held[i],
                                   .x = static_cast<float>(mouse_x) * scale,
                                   .y = static_cast<float>(mouse_y) * scale};
            event.is_double =
                event.is_down && double_click.press(event.button, event.x, event.y, moved_at);
            arriving.emplace_back(event);
        }
    }
}

void Window::State::on_mouse(double x, double y) {
    moved_at = HostClock::now();
    const float scale = pixels_per_unit();
    const float dx = static_cast<float>(x - mouse_x) * scale;
    const float dy = static_cast<float>(y - mouse_y) * scale;
    mouse_x = x;
    mouse_y = y;
    // Only drags are reported: a mouse that moves with no button held changes nothing.
    const auto* const held = std::find(is_held.begin(), is_held.end(), true);
    if (held == is_held.end()) {
        return;
    }
    const auto index = static_cast<std::size_t>(held - is_held.begin());
    arriving.emplace_back(MouseDragEvent{.button = kMouseButtons[index].second,
                                         .has_shift = has_shift(),
                                         .dx = dx,
                                         .dy = dy,
                                         .x = static_cast<float>(x) * scale,
                                         .y = static_cast<float>(y) * scale});
}

/// Framebuffer pixels for each screen coordinate: 1, or 2 on fine monitors of some systems.
float Window::State::pixels_per_unit() const {
    int width = 0;
    int pixels = 0;
    glfwGetWindowSize(handle, &width, nullptr);
    glfwGetFramebufferSize(handle, &pixels, nullptr);
    return width > 0 ? static_cast<float>(pixels) / static_cast<float>(width) : 1.0F;
}

namespace {

// The function by which the driver tells that it has lost the context; null: it cannot. The context
// is current.
using ResetStatus = unsigned (*)();
ResetStatus reset_status_of(GLFWwindow* window) {
    return glfwGetWindowAttrib(window, GLFW_CONTEXT_ROBUSTNESS) == GLFW_LOSE_CONTEXT_ON_RESET
               ? reinterpret_cast<ResetStatus>(glfwGetProcAddress("glGetGraphicsResetStatusARB"))
               : nullptr;
}

}  // namespace

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Expected<Window> Window::create(const WindowOptions& options) {
    auto state = std::make_unique<State>();
    if (!state->glfw.is_up()) {
        // GLFW's own words for a missing display do not tell a user what to do.
        const char* const display = std::getenv("DISPLAY");  // NOLINT(concurrency-mt-unsafe)
        return fail(display == nullptr || *display == '\0'
                        ? "no display: DISPLAY is not set; " + options.otherwise
                        : "no display: \"" + std::string(display) + "\": " + last_error() + "; " +
                              options.otherwise);
    }
    if (options.outlives_loss) {
        outlive_display();
    }
    state->handle = open_glfw_window(options);
    if (state->handle == nullptr) {
        return fail("no window with OpenGL 3.3: " + last_error() +
                    "; update the graphics driver, or " + options.otherwise);
    }
    glfwMakeContextCurrent(state->handle);
    // Drawn in software, a picture takes all cores: sound comes first.
    put_threads_behind("llvmpipe");
    // Swapping waits for the monitor's refresh.
    glfwSwapInterval(1);
    glfwGetCursorPos(state->handle, &state->mouse_x, &state->mouse_y);
    state->reset_status =
        options.reset_status != nullptr ? options.reset_status : reset_status_of(state->handle);
    state->max_fps = options.max_fps;
    state->refresh_rate = refresh_rate_of(state->handle);
    state->limiter = limiter_for(state->max_fps, state->refresh_rate);
    // Behind everything that can fail, so that no callback sees a half-made state.
    state->listen();
    Window window(std::move(state));
    if (options.is_fullscreen) {
        window.toggle_fullscreen();
    }
    return window;
}

std::span<const WindowEvent> Window::poll_events() {
    if (!state_->is_lost()) {
        glfwPollEvents();
        state_->show_or_hide_pointer();
    }
    if (state_->has_moved && !state_->is_lost()) {
        state_->follow_monitor();
    }
    // The two vectors keep their storage: no allocation once they have grown.
    state_->delivered.clear();
    std::swap(state_->delivered, state_->arriving);
    return state_->delivered;
}

bool Window::should_close() const {
    return state_->is_lost() || glfwWindowShouldClose(state_->handle) == GLFW_TRUE;
}

std::string_view Window::why_lost() const {
    return is_display_lost()          ? "the display is gone"
           : state_->has_lost_context ? "the graphics driver was reset and has lost the pictures"
                                      : "";
}

void Window::request_close() { glfwSetWindowShouldClose(state_->handle, GLFW_TRUE); }

void Window::stay_open() { glfwSetWindowShouldClose(state_->handle, GLFW_FALSE); }

PointerPlace Window::pointer() const {
    const float scale = state_->pixels_per_unit();
    return {static_cast<float>(state_->mouse_x) * scale,
            static_cast<float>(state_->mouse_y) * scale};
}

FrameTarget Window::frame() const {
    FrameTarget target;
    // Framebuffer 0 with its origin at (0, 0) is FrameTarget's default.
    glfwGetFramebufferSize(state_->handle, &target.width, &target.height);
    // Asked last: the display may have gone with the question.
    return state_->is_lost() ? FrameTarget() : target;
}

float Window::content_scale() const {
    float scale = 1.0F;
    glfwGetWindowContentScale(state_->handle, &scale, nullptr);
    return scale;
}

double Window::refresh_rate() const { return state_->refresh_rate.value_or(kUsualRefreshRate); }

void Window::present() {
    if (state_->is_lost()) {
        return;
    }
    glfwSwapBuffers(state_->handle);
    state_->has_lost_context = state_->reset_status != nullptr && state_->reset_status() != 0;
    // Under vertical sync this is mostly past due and returns at once.
    sleep_until(state_->limiter.next_due(std::chrono::time_point_cast<Nanos>(HostClock::now())));
}

// The place before is remembered for the way back: GLFW does not.
void Window::State::fill(GLFWmonitor* monitor) {
    if (glfwGetWindowMonitor(handle) == nullptr) {
        windowed = rectangle_of(handle);
    }
    const GLFWvidmode* const mode = glfwGetVideoMode(monitor);
    glfwSetWindowMonitor(handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::toggle_fullscreen() {
    const Rectangle& back = state_->windowed;
    // Without a monitor the window goes back to where it was.
    if (is_fullscreen()) {
        glfwSetWindowMonitor(
            state_->handle, nullptr, back.x, back.y, back.width, back.height, GLFW_DONT_CARE);
    } else {
        GLFWmonitor* const monitor = monitor_of(state_->handle);
        if (monitor == nullptr) {
            return;
        }
        state_->fill(monitor);
    }
    follow_monitor();
}

std::string Window::go_to_next_monitor() {
    GLFWmonitor* const full = glfwGetWindowMonitor(state_->handle);
    const auto monitors = all_monitors();
    const auto here = std::find(
        monitors.begin(), monitors.end(), full != nullptr ? full : monitor_of(state_->handle));
    if (monitors.size() < 2 || here == monitors.end()) {
        return {};
    }
    GLFWmonitor* const next = here + 1 != monitors.end() ? *(here + 1) : monitors.front();
    state_->fill(next);
    follow_monitor();
    return name_of(next);
}

// Rate and vertical sync of the monitor that the window is on now.
void Window::follow_monitor() {
    glfwSwapInterval(1);  // some drivers forget it with the mode
    state_->follow_monitor();
}

std::optional<WindowPlace> Window::place() const {
    if (state_->is_lost()) {
        return std::nullopt;
    }
    const Rectangle own = is_fullscreen() ? state_->windowed : rectangle_of(state_->handle);
    WindowPlace place;
    place.x = own.x;
    place.y = own.y;
    place.width = own.width;
    place.height = own.height;
    if (GLFWmonitor* const monitor = monitor_under(own)) {
        place.monitor = name_of(monitor);
        glfwGetMonitorPos(monitor, &place.monitor_x, &place.monitor_y);
    }
    return place;
}

void Window::show_pointer(bool is_shown) {
    state_->is_pointer_wanted = is_shown;
    state_->show_or_hide_pointer();
}

bool Window::is_fullscreen() const { return glfwGetWindowMonitor(state_->handle) != nullptr; }

namespace {

/// Returns whether it is on now.
bool toggle(GLFWwindow* window, int attribute) {
    const bool is_on = glfwGetWindowAttrib(window, attribute) != GLFW_TRUE;
    glfwSetWindowAttrib(window, attribute, is_on ? GLFW_TRUE : GLFW_FALSE);
    return is_on;
}

}  // namespace

bool Window::toggle_border() { return toggle(state_->handle, GLFW_DECORATED); }

bool Window::toggle_on_top() { return toggle(state_->handle, GLFW_FLOATING); }

bool Window::is_transparent() const {
    return glfwGetWindowAttrib(state_->handle, GLFW_TRANSPARENT_FRAMEBUFFER) == GLFW_TRUE;
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->handle, title.c_str());
}

}  // namespace raks::render
