#include "render/panes/pane_context.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/panes/widgets.hpp"

namespace raks::render {
namespace {

constexpr PaneArea kArea{400, 300, 1.0F};
constexpr Box kButton{100.0F, 50.0F, 80.0F, 30.0F};

MouseButtonEvent button(bool is_down, float x, float y) {
    return {MouseButton::left, is_down, x, y};
}

/// Frames with one button, until all that came is taken up; counts its clicks.
class PaneClicks : public testing::Test {
 protected:
    int clicks(const std::vector<WindowEvent>& events,
               PointerPlace pointer,
               ButtonLook look = ButtonLook::usual,
               const PaneArea& area = kArea) {
        int clicks = 0;
        // A frame without events first: then ImGui knows what lies under the pointer.
        for (int frames = 0; frames < 2 || context_.has_waiting(); ++frames) {
            if (frames == 1) {
                context_.take(events);
            }
            const PaneFrame frame = context_.begin(area, pointer);
            clicks += pane_button(frame, kButton, "Go", look) ? 1 : 0;
            context_.end();
        }
        return clicks;
    }

    PaneContext context_;
};

TEST_F(PaneClicks, a_click_counts_also_when_it_is_over_before_the_next_frame) {
    EXPECT_EQ(clicks({}, {120.0F, 60.0F}), 0);
    EXPECT_EQ(clicks({button(true, 120, 60), button(false, 120, 60)}, {120.0F, 60.0F}), 1);
    EXPECT_EQ(clicks({button(true, 120, 60),
                      button(false, 120, 60),
                      button(true, 121, 60),
                      button(false, 121, 60)},
                     {121.0F, 60.0F}),
              2);
}

TEST_F(PaneClicks, a_click_beside_the_button_or_pulled_off_it_is_none) {
    EXPECT_EQ(clicks({button(true, 20, 60), button(false, 20, 60)}, {20.0F, 60.0F}), 0);
    EXPECT_EQ(clicks({button(true, 120, 60), button(false, 300, 200)}, {300.0F, 200.0F}), 0);
}

TEST_F(PaneClicks, a_button_that_is_off_is_not_clicked) {
    EXPECT_EQ(
        clicks({button(true, 120, 60), button(false, 120, 60)}, {120.0F, 60.0F}, ButtonLook::off),
        0);
}

TEST_F(PaneClicks, places_are_units_and_not_pixels) {
    EXPECT_EQ(clicks({button(true, 240, 120), button(false, 240, 120)},
                     {240.0F, 120.0F},
                     ButtonLook::usual,
                     {800, 600, 2.0F}),
              1);
}

TEST(PaneFrame, has_the_wheel_of_its_time) {
    PaneContext context;
    context.take(std::vector<WindowEvent>{ScrollEvent{0.0F, 1.0F}, ScrollEvent{0.0F, 2.0F}});
    std::vector<float> wheel;
    for (int i = 0; i < 3; ++i) {
        wheel.push_back(context.begin(kArea, {}).wheel);
        context.end();
    }
    EXPECT_EQ(wheel, (std::vector<float>{0.0F, 3.0F, 0.0F})) << "nothing in the first frame of all";
}

TEST(PaneFrame, sees_press_drag_and_release_one_after_the_other) {
    PaneContext context;
    context.take(std::vector<WindowEvent>{button(true, 10, 20),
                                          MouseDragEvent{.x = 30.0F, .y = 40.0F},
                                          MouseDragEvent{.x = 50.0F, .y = 60.0F},
                                          button(false, 51, 60)});
    std::vector<glm::vec2> places;
    std::vector<bool> held;
    while (context.has_waiting()) {
        const PaneFrame frame = context.begin(kArea, {51.0F, 60.0F});
        places.push_back(frame.pointer);
        held.push_back(frame.holds(MouseButton::left));
        context.end();
    }
    ASSERT_EQ(places.size(), 4U) << "the first frame takes up nothing";
    EXPECT_EQ(places[1], glm::vec2(10.0F, 20.0F));
    EXPECT_EQ(held, (std::vector<bool>{false, true, true, false}));
    EXPECT_EQ(places[3], glm::vec2(51.0F, 60.0F));
}

TEST(PaneFrame, has_one_key_or_change_of_a_button) {
    PaneContext context;
    context.take(std::vector<WindowEvent>{KeyEvent{.key = key_of(U'a')},
                                          KeyEvent{.key = key_of(U'b')},
                                          button(true, 5, 5),
                                          KeyEvent{.key = key_of(U'c')},
                                          button(false, 5, 5)});
    std::vector<std::size_t> keys;
    std::vector<bool> held;
    while (context.has_waiting()) {
        const PaneFrame frame = context.begin(kArea, {});
        keys.push_back(frame.keys.size());
        held.push_back(frame.holds(MouseButton::left));
        context.end();
    }
    EXPECT_EQ(keys, (std::vector<std::size_t>{0, 1, 1, 0, 1, 0}));
    EXPECT_EQ(held, (std::vector<bool>{false, false, false, true, true, false}));
}

TEST(PaneScale, grows_half_as_much_as_the_window_in_quarters) {
    EXPECT_EQ(pane_scale(1280, 720, 1.0F), 1.0F);
    EXPECT_EQ(pane_scale(800, 480, 1.0F), 1.0F);
    EXPECT_EQ(pane_scale(1920, 1080, 1.0F), 1.25F);
    EXPECT_EQ(pane_scale(3840, 2160, 1.0F), 2.0F);
    EXPECT_EQ(pane_scale(2560, 1440, 2.0F), 2.0F);
}

TEST(PaneNames, of_paints_have_their_colours_and_others_one_each) {
    EXPECT_EQ(named_colour("green").rgb, named_colour("green").rgb);
    EXPECT_NE(named_colour("head").rgb, named_colour("c7").rgb);
    EXPECT_EQ(named_colour("head").rgb, named_colour("head").rgb);
}

}  // namespace
}  // namespace raks::render
