#include "render/gl/window.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <optional>

#include "render/overlay/overlay.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/xvfb.hpp"

// last, for X.h defines names such as None
#include <X11/Xlib.h>

namespace raks::render {
namespace {

using test::run_program;

/// A window on a display of its own, focused (there is no window manager to do it).
class WindowOnXvfb : public testing::Test {
 protected:
    void SetUp() override {
        auto window = Window::create({.title = "raks window test", .width = 320, .height = 180});
        ASSERT_TRUE(window) << window.error().message;
        window_.emplace(std::move(*window));
        const std::string found =
            run_program({"xdotool", "search", "--sync", "--name", "raks window test"});
        id_ = found.substr(0, found.find('\n'));
        run_program({"xdotool", "windowfocus", "--sync", id_});
    }

    /// Events until `is_enough`, or until it took 300 pictures (5 s).
    std::vector<WindowEvent> events_until(
        const std::function<bool(const std::vector<WindowEvent>&)>& is_enough) {
        std::vector<WindowEvent> all;
        for (int picture = 0; picture < 300 && !is_enough(all); ++picture) {
            for (const WindowEvent& event : window_->poll_events()) {
                all.push_back(event);
            }
            window_->present();
        }
        return all;
    }

    /// What a key pressed by xdotool arrives as.
    std::optional<KeyEvent> press(const std::string& keysym) {
        run_program({"xdotool", "key", keysym});
        const auto events = events_until([](const auto& all) { return !all.empty(); });
        const auto* const key = events.empty() ? nullptr : std::get_if<KeyEvent>(&events.front());
        return key != nullptr ? std::optional(*key) : std::nullopt;
    }

    test::Xvfb xvfb_{640, 480};
    std::optional<Window> window_;
    std::string id_;
};

/// What a window manager sends when its close button is clicked. (Debian 12's xdotool cannot.)
void ask_to_close(const std::string& window_id) {
    Display* const display = XOpenDisplay(nullptr);
    ASSERT_NE(display, nullptr);
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = std::stoul(window_id);
    event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", True);
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", True));
    XSendEvent(display, event.xclient.window, False, NoEventMask, &event);
    XCloseDisplay(display);  // flushes
}

struct KeyCase {
    const char* keysym;
    Key key;
    bool has_shift;
};

TEST_F(WindowOnXvfb, keys_arrive_as_characters_or_by_name) {
    const std::array cases = {
        KeyCase{"space", Key::space, false},
        KeyCase{"s", key_of(U's'), false},
        KeyCase{"Q", key_of(U'q'), true},
        KeyCase{"question", key_of(U'?'), true},
        KeyCase{"bracketleft", key_of(U'['), false},
        KeyCase{"bracketright", key_of(U']'), false},
        KeyCase{"Left", Key::left, false},
        KeyCase{"shift+Right", Key::right, true},
        KeyCase{"Up", Key::up, false},
        KeyCase{"Down", Key::down, false},
        KeyCase{"Home", Key::home, false},
        KeyCase{"Tab", Key::tab, false},
        KeyCase{"F11", Key::f11, false},
        KeyCase{"Escape", Key::escape, false},
    };
    for (const KeyCase& expected : cases) {
        const auto key = press(expected.keysym);
        ASSERT_TRUE(key) << expected.keysym;
        EXPECT_EQ(key->key, expected.key) << expected.keysym;
        EXPECT_EQ(key->has_shift, expected.has_shift) << expected.keysym;
        EXPECT_FALSE(key->has_control) << expected.keysym;
        EXPECT_FALSE(key->is_repeat) << expected.keysym;
    }
}

TEST_F(WindowOnXvfb, one_press_is_one_event) {
    run_program({"xdotool", "key", "space", "s", "space"});
    const auto events = events_until([](const auto& all) { return all.size() >= 3; });
    EXPECT_EQ(events.size(), 3U);
}

TEST_F(WindowOnXvfb, a_drag_with_the_right_button_sums_to_the_way_of_the_mouse) {
    run_program({"xdotool", "mousemove", "--window", id_, "100", "100"});
    (void)window_->poll_events();
    run_program(
        {"xdotool", "mousedown", "3", "mousemove", "--window", id_, "150", "80", "mouseup", "3"});
    const auto events = events_until([](const auto& all) {
        const auto* const last = all.empty() ? nullptr : std::get_if<MouseButtonEvent>(&all.back());
        return last != nullptr && !last->is_down;
    });
    float dx = 0.0F;
    float dy = 0.0F;
    for (const WindowEvent& event : events) {
        if (const auto* const drag = std::get_if<MouseDragEvent>(&event)) {
            EXPECT_EQ(drag->button, MouseButton::right);
            dx += drag->dx;
            dy += drag->dy;
        }
    }
    EXPECT_EQ(dx, 50.0F);
    EXPECT_EQ(dy, -20.0F);
}

TEST_F(WindowOnXvfb, the_wheel_arrives_as_scroll) {
    run_program({"xdotool",
                 "mousemove",
                 "--window",
                 id_,
                 "50",
                 "50",
                 "click",
                 "4",
                 "click",
                 "5",
                 "click",
                 "5"});
    float sum = 0.0F;
    int steps = 0;
    (void)events_until([&](const auto& all) {
        sum = 0.0F;
        steps = 0;
        for (const WindowEvent& event : all) {
            if (const auto* const scroll = std::get_if<ScrollEvent>(&event)) {
                sum += scroll->dy;
                ++steps;
            }
        }
        return steps >= 3;
    });
    EXPECT_EQ(steps, 3);
    EXPECT_EQ(sum, -1.0F);
}

TEST_F(WindowOnXvfb, what_was_drawn_is_read_back_top_row_first) {
    const FrameTarget frame = window_->frame();
    ASSERT_EQ(frame.width, 320);
    ASSERT_EQ(frame.height, 180);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(1.0F, 0.5F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 170, 20, 10);  // the top left corner
    glClearColor(0.0F, 0.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    std::vector<std::uint8_t> rgba(std::size_t{320} * 180 * 4);
    ASSERT_TRUE(read_rgba(frame, rgba));
    EXPECT_EQ(rgba[0], 0);
    EXPECT_EQ(rgba[2], 255);
    EXPECT_EQ(rgba[rgba.size() - 4], 255);
    EXPECT_NEAR(rgba[rgba.size() - 3], 128, 1);
    EXPECT_EQ(rgba[rgba.size() - 2], 0);
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

TEST_F(WindowOnXvfb, the_overlay_draws_in_a_window_as_off_screen) {
    auto overlay = Overlay::create();
    ASSERT_TRUE(overlay) << overlay.error().message;
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    overlay->draw({.bpm = 120.0, .confidence = 1.0F}, OverlayView::shown, window_->frame());
    std::vector<std::uint8_t> rgba(std::size_t{320} * 180 * 4);
    ASSERT_TRUE(read_rgba(window_->frame(), rgba));
    // In a small window it is the tempo alone, in the colour of text.
    int bright = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        bright += rgba[i] > 140 && rgba[i + 1] > 140 && rgba[i + 2] > 130 ? 1 : 0;
    }
    EXPECT_GT(bright, 20);
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

TEST_F(WindowOnXvfb, full_screen_fills_the_monitor_and_comes_back) {
    const auto frame_is = [&](int width, int height) {
        (void)events_until([&](const auto&) {
            return window_->frame().width == width && window_->frame().height == height;
        });
        return window_->frame().width == width && window_->frame().height == height;
    };
    EXPECT_FALSE(window_->is_fullscreen());
    window_->toggle_fullscreen();
    EXPECT_TRUE(window_->is_fullscreen());
    EXPECT_TRUE(frame_is(640, 480));
    window_->toggle_fullscreen();
    EXPECT_FALSE(window_->is_fullscreen());
    EXPECT_TRUE(frame_is(320, 180));
}

TEST_F(WindowOnXvfb, a_monitor_without_a_rate_counts_as_60_a_second) {
    EXPECT_EQ(window_->refresh_rate(), 60.0);  // Xvfb tells 0
    EXPECT_GT(window_->content_scale(), 0.0F);
    EXPECT_FALSE(window_->is_transparent());
}

TEST_F(WindowOnXvfb, asked_to_close_by_the_system_it_says_so) {
    EXPECT_FALSE(window_->should_close());
    ask_to_close(id_);
    (void)events_until([&](const auto&) { return window_->should_close(); });
    EXPECT_TRUE(window_->should_close());
}

TEST_F(WindowOnXvfb, opens_where_it_was) {
    const auto here = window_->place();
    ASSERT_TRUE(here);
    EXPECT_EQ(here->width, 320);
    EXPECT_EQ(here->height, 180);
    EXPECT_FALSE(here->monitor.empty());
    WindowPlace there = *here;
    there.x = 200;
    there.y = 150;
    there.width = 400;
    there.height = 300;
    window_.reset();
    auto window = Window::create({.place = there});
    ASSERT_TRUE(window) << window.error().message;
    window_.emplace(std::move(*window));
    (void)events_until([&](const auto&) { return window_->place() == there; });
    EXPECT_EQ(window_->place()->x, 200);
    EXPECT_EQ(window_->place()->y, 150);
    EXPECT_EQ(window_->frame().width, 400);
    window_->toggle_fullscreen();
    EXPECT_EQ(window_->place(), there) << "over a full screen it is the place to go back to";
}

TEST_F(WindowOnXvfb, there_is_no_next_monitor_where_there_is_one) {
    EXPECT_EQ(window_->go_to_next_monitor(), "");
    EXPECT_FALSE(window_->is_fullscreen());
}

TEST_F(WindowOnXvfb, two_clicks_at_once_are_a_double_click) {
    run_program(
        {"xdotool", "mousemove", "--window", id_, "50", "50", "click", "--repeat", "2", "1"});
    std::vector<bool> presses;
    for (const WindowEvent& event : events_until([](const auto& all) { return all.size() >= 4; })) {
        const auto* const button = std::get_if<MouseButtonEvent>(&event);
        if (button != nullptr && button->is_down) {
            presses.push_back(button->is_double);
        }
    }
    EXPECT_EQ(presses, (std::vector{false, true}));
}

TEST_F(WindowOnXvfb, a_driver_that_was_reset_ends_it) {
    window_.reset();
    static unsigned status = 0;
    auto window = Window::create(
        {.width = 64, .height = 64, .outlives_loss = true, .reset_status = [] { return status; }});
    ASSERT_TRUE(window) << window.error().message;
    window->present();
    EXPECT_EQ(window->why_lost(), "");
    EXPECT_FALSE(window->should_close());
    status = 0x8253;  // GL_GUILTY_CONTEXT_RESET
    window->present();
    EXPECT_EQ(window->why_lost(), "the graphics driver was reset and has lost the pictures");
    EXPECT_TRUE(window->should_close());
    EXPECT_EQ(window->frame().width, 0);
    EXPECT_TRUE(window->poll_events().empty());
    EXPECT_EQ(window->place(), std::nullopt);
    window->present();
}

TEST_F(WindowOnXvfb, an_alpha_of_zero_is_kept_for_a_transparent_window) {
    window_.reset();
    auto window = Window::create({.width = 64, .height = 64, .is_transparent = true});
    ASSERT_TRUE(window) << window.error().message;
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    std::vector<std::uint8_t> rgba(std::size_t{64} * 64 * 4, 1);
    ASSERT_TRUE(read_rgba(window->frame(), rgba));
    EXPECT_EQ(rgba[3], 0);
}

TEST(Window, without_a_display_the_error_says_what_to_do) {
    unsetenv("DISPLAY");  // NOLINT(concurrency-mt-unsafe)
    const auto window = Window::create({});
    ASSERT_FALSE(window);
    EXPECT_EQ(window.error().message,
              "no display: DISPLAY is not set; use --headless, or `raks render`");
}

TEST(Window, a_display_that_does_not_answer_is_named) {
    setenv("DISPLAY", ":4711", 1);  // NOLINT(concurrency-mt-unsafe)
    const auto window = Window::create({});
    ASSERT_FALSE(window);
    EXPECT_NE(window.error().message.find("\":4711\""), std::string::npos)
        << window.error().message;
}

}  // namespace
}  // namespace raks::render

namespace raks::render {
namespace {

using std::chrono::milliseconds;

HostTime at(Nanos since_start) { return HostTime(std::chrono::seconds(1000) + since_start); }

TEST(FrameLimiter, a_fast_loop_is_held_at_the_period_without_drift) {
    FrameLimiter limiter(50.0, FrameLimiter::Pace::exact);
    HostTime now = at(Nanos(0));
    now = limiter.next_due(now);  // the first picture waits for nothing
    EXPECT_EQ(now, at(Nanos(0)));
    for (int picture = 1; picture <= 1000; ++picture) {
        now = limiter.next_due(now + milliseconds(3));
        ASSERT_EQ(now, at(picture * milliseconds(20)));
    }
}

TEST(FrameLimiter, a_late_picture_is_not_followed_by_a_burst) {
    FrameLimiter limiter(50.0, FrameLimiter::Pace::exact);
    (void)limiter.next_due(at(Nanos(0)));
    EXPECT_EQ(limiter.next_due(at(milliseconds(95))), at(milliseconds(95)));
    EXPECT_EQ(limiter.next_due(at(milliseconds(96))), at(milliseconds(115)));
}

TEST(FrameLimiter, a_loop_that_vsync_paces_never_sleeps) {
    FrameLimiter limiter(60.0, FrameLimiter::Pace::behind_vsync);
    for (int picture = 0; picture < 1000; ++picture) {
        const HostTime now = at(nanos_from_seconds(picture / 60.0));
        ASSERT_LE(limiter.next_due(now), now) << "picture " << picture;
    }
}

TEST(FrameLimiter, sleeping_until_a_moment_that_has_passed_returns) {
    sleep_until(HostTime{});
    const HostTime due = std::chrono::time_point_cast<Nanos>(HostClock::now()) + milliseconds(2);
    sleep_until(due);
    EXPECT_GE(HostClock::now(), due);
}

}  // namespace
}  // namespace raks::render
