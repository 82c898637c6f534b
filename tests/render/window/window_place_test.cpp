#include "render/gl/window_place.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "render/gl/mouse_button.hpp"

namespace raks::render {
namespace {

MonitorPlace monitor(const std::string& name, int x, int y, int width, int height) {
    MonitorPlace place{.name = name};
    place.x = place.work_x = x;
    place.y = place.work_y = y;
    place.work_width = width;
    place.work_height = height;
    return place;
}

// Two screens side by side; a panel takes the upper 30 of the first.
std::array<MonitorPlace, 2> desktop() {
    std::array places = {monitor("eDP-1", 0, 0, 1920, 1080), monitor("HDMI-1", 1920, 0, 1280, 720)};
    places[0].work_y = 30;
    places[0].work_height = 1050;
    return places;
}

WindowPlace window_on(const std::string& name, int monitor_x, int x, int y) {
    WindowPlace place;
    place.x = x;
    place.y = y;
    place.width = 640;
    place.height = 360;
    place.monitor = name;
    place.monitor_x = monitor_x;
    return place;
}

using Point = OpeningPlace::Point;

TEST(OpeningPlace, is_where_it_was_while_the_monitor_is_where_it_was) {
    const auto places = desktop();
    EXPECT_EQ(opening_place(window_on("eDP-1", 0, 100, 200), places).at, (Point{100, 200}));
    EXPECT_EQ(opening_place(window_on("HDMI-1", 1920, 2000, 50), places).at, (Point{2000, 50}));
}

TEST(OpeningPlace, follows_a_monitor_that_was_moved) {
    const auto places = desktop();
    EXPECT_EQ(opening_place(window_on("HDMI-1", -1280, -1200, 50), places).at, (Point{2000, 50}));
}

TEST(OpeningPlace, of_two_monitors_with_one_name_is_the_one_that_is_there) {
    const std::array places = {monitor("DP", 0, 0, 1920, 1080), monitor("DP", 1920, 0, 1920, 1080)};
    EXPECT_EQ(opening_place(window_on("DP", 1920, 2000, 50), places).at, (Point{2000, 50}));
    EXPECT_EQ(opening_place(window_on("DP", 0, 80, 50), places).at, (Point{80, 50}));
    EXPECT_EQ(opening_place(window_on("DP", 5000, 5080, 50), places).at, (Point{80, 50}))
        << "neither is: the first";
}

TEST(OpeningPlace, is_never_off_the_screen) {
    const auto places = desktop();
    EXPECT_EQ(opening_place(window_on("eDP-1", 0, -500, -500), places).at, (Point{0, 30}));
    EXPECT_EQ(opening_place(window_on("eDP-1", 0, 99'999, 99'999), places).at, (Point{1280, 720}));
    EXPECT_EQ(opening_place(window_on("HDMI-1", 1920, 3000, 600), places).at, (Point{2560, 360}));
    WindowPlace large = window_on("HDMI-1", 1920, 1900, -10);
    large.width = 5000;
    large.height = 4000;
    const OpeningPlace opening = opening_place(large, places);
    EXPECT_EQ(opening.width, 1280);
    EXPECT_EQ(opening.height, 720);
    EXPECT_EQ(opening.at, (Point{1920, 0}));
}

TEST(OpeningPlace, of_a_monitor_that_is_gone_is_the_desktops_choice) {
    const auto places = desktop();
    WindowPlace gone = window_on("VGA-1", 3200, 3300, 100);
    gone.width = 2560;
    const OpeningPlace opening = opening_place(gone, places);
    EXPECT_EQ(opening.at, std::nullopt);
    EXPECT_EQ(opening.width, 1920) << "as much as the first monitor has room for";
    EXPECT_EQ(opening.height, 360);
    EXPECT_EQ(opening_place(gone, {}).at, (Point{3300, 100})) << "nothing is known of monitors";
}

TEST(OpeningPlace, of_a_monitor_without_room_is_still_a_window) {
    const std::array places = {monitor("none", 5, 6, 0, 0)};
    const OpeningPlace opening = opening_place(window_on("none", 5, 7, 8), places);
    EXPECT_EQ(opening.width, 1);
    EXPECT_EQ(opening.height, 1);
    EXPECT_EQ(opening.at, (Point{5, 6}));
}

using std::chrono::milliseconds;

HostTime moment(milliseconds since_start) {
    return HostTime(std::chrono::seconds(1000) + since_start);
}

TEST(DoubleClick, is_two_presses_of_one_button_soon_at_one_place) {
    struct Press {
        MouseButton button;
        float x;
        float y;
        int ms;
    };
    const struct {
        Press second;
        bool is_double;
    } cases[] = {
        {{MouseButton::left, 100, 50, 200}, true},
        {{MouseButton::left, 108, 42, 400}, true},
        {{MouseButton::left, 100, 50, 401}, false},
        {{MouseButton::left, 109, 50, 200}, false},
        {{MouseButton::left, 100, 41, 200}, false},
        {{MouseButton::right, 100, 50, 200}, false},
    };
    for (const auto& c : cases) {
        DoubleClick rule;
        EXPECT_FALSE(rule.press(MouseButton::left, 100, 50, moment(milliseconds(0))));
        EXPECT_EQ(
            rule.press(c.second.button, c.second.x, c.second.y, moment(milliseconds(c.second.ms))),
            c.is_double)
            << c.second.x << ' ' << c.second.y << ' ' << c.second.ms;
    }
}

TEST(DoubleClick, a_third_press_begins_anew) {
    DoubleClick rule;
    const auto press = [&](int ms) {
        return rule.press(MouseButton::left, 0, 0, moment(milliseconds(ms)));
    };
    EXPECT_FALSE(press(0));
    EXPECT_TRUE(press(100));
    EXPECT_FALSE(press(200));
    EXPECT_TRUE(press(300));
    EXPECT_FALSE(press(1000));
    EXPECT_FALSE(press(1500)) << "too late for the one before";
    EXPECT_TRUE(press(1600));
}

}  // namespace
}  // namespace raks::render
