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

TEST(PaneFrame, has_the_keys_and_the_wheel_of_its_time) {
    PaneContext context;
    context.take(std::vector<WindowEvent>{
        KeyEvent{.key = key_of(U'a')}, ScrollEvent{0.0F, 1.0F}, ScrollEvent{0.0F, 2.0F}});
    const PaneFrame first = context.begin(kArea, {});
    ASSERT_EQ(first.keys.size(), 1U);
    EXPECT_EQ(first.keys.front().key, key_of(U'a'));
    EXPECT_EQ(first.wheel, 3.0F);
    context.end();
    const PaneFrame second = context.begin(kArea, {});
    EXPECT_TRUE(second.keys.empty());
    EXPECT_EQ(second.wheel, 0.0F);
    context.end();
}

TEST(PaneFrame, sees_a_press_where_it_was_and_then_the_drag) {
    PaneContext context;
    context.take(std::vector<WindowEvent>{
        button(true, 10, 20), MouseDragEvent{.x = 50.0F, .y = 60.0F}, button(false, 50, 60)});
    const PaneFrame press = context.begin(kArea, {90.0F, 90.0F});
    EXPECT_TRUE(press.has_pressed(MouseButton::left));
    EXPECT_EQ(press.pointer, glm::vec2(10.0F, 20.0F));
    context.end();
    const PaneFrame release = context.begin(kArea, {90.0F, 90.0F});
    EXPECT_FALSE(release.holds(MouseButton::left));
    EXPECT_EQ(release.pointer, glm::vec2(50.0F, 60.0F));
    context.end();
}

TEST(PaneNames, of_paints_have_their_colours_and_others_one_each) {
    EXPECT_EQ(named_colour("green").rgb, named_colour("green").rgb);
    EXPECT_NE(named_colour("head").rgb, named_colour("c7").rgb);
    EXPECT_EQ(named_colour("head").rgb, named_colour("head").rgb);
}

}  // namespace
}  // namespace raks::render
