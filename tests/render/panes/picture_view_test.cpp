#include "render/panes/picture_view.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

constexpr Box kBox{10.0F, 20.0F, 400.0F, 300.0F};

void expect_near(const glm::dvec2& one, const glm::dvec2& other, double tolerance) {
    EXPECT_LT(glm::distance(one, other), tolerance)
        << one.x << ", " << one.y << " against " << other.x << ", " << other.y;
}

TEST(PicturePlace, fits_all_of_the_picture_into_the_box) {
    const PicturePlace place(kBox, 800, 400, {});
    const Box whole = place.whole();
    EXPECT_FLOAT_EQ(whole.x, kBox.x);
    EXPECT_FLOAT_EQ(whole.width, kBox.width);
    EXPECT_FLOAT_EQ(whole.height, 200.0F);
    EXPECT_FLOAT_EQ(whole.y - kBox.y, kBox.bottom() - whole.bottom());
    // The corner of the picture is half a pixel before the middle of its first pixel.
    expect_near(place.pixel_at({whole.x, whole.y}), {-0.5, -0.5}, 1e-4);
}

TEST(PicturePlace, its_two_ways_are_inverse_at_any_zoom) {
    for (const PictureZoom& zoom :
         {PictureZoom{}, PictureZoom{3.0, {0.3, 0.6}}, PictureZoom{40.0, {0.9, 0.1}}}) {
        const PicturePlace place(kBox, 1280, 720, zoom);
        for (const glm::dvec2 pixel : {glm::dvec2(0.0), glm::dvec2(639.5, 300.25)}) {
            expect_near(place.pixel_at(place.in_box(pixel)), pixel, 2e-3);
        }
    }
}

TEST(PicturePlace, zooming_keeps_what_is_under_the_pointer) {
    const PicturePlace before(kBox, 800, 600, {2.0, {0.5, 0.5}});
    const glm::vec2 pointer(180.0F, 130.0F);
    const PicturePlace after(kBox, 800, 600, before.zoomed(pointer, 1.5));
    expect_near(after.pixel_at(pointer), before.pixel_at(pointer), 1e-3);
    EXPECT_NEAR(after.unit(), 1.5 * before.unit(), 1e-9);
}

TEST(PicturePlace, zooms_no_farther_out_than_the_whole_picture_and_stays_in_it) {
    const PicturePlace place(kBox, 800, 600, {});
    EXPECT_EQ(place.zoomed({100.0F, 100.0F}, 0.1), PictureZoom{});
    EXPECT_EQ(place.zoomed({100.0F, 100.0F}, 1e9).times, PictureZoom::kMostTimes);
    EXPECT_EQ(place.moved({500.0F, 500.0F}), PictureZoom{});
    const PicturePlace near(kBox, 800, 600, {4.0, {0.5, 0.5}});
    const PictureZoom moved = near.moved({1e6F, -1e6F});
    EXPECT_DOUBLE_EQ(moved.middle.x, 0.125);
    EXPECT_DOUBLE_EQ(moved.middle.y, 0.875);
}

TEST(PicturePlace, moves_with_the_hand) {
    const PicturePlace before(kBox, 800, 600, {4.0, {0.5, 0.5}});
    const PicturePlace after(kBox, 800, 600, before.moved({30.0F, -12.0F}));
    const glm::vec2 shift = after.in_box({400.0, 300.0}) - before.in_box({400.0, 300.0});
    EXPECT_NEAR(shift.x, 30.0F, 1e-3F);
    EXPECT_NEAR(shift.y, -12.0F, 1e-3F);
}

/// The gestures that events make in frames of one picture.
std::vector<PictureGesture> gestures(const std::vector<WindowEvent>& events) {
    PaneContext context;
    std::vector<PictureGesture> all;
    // A frame without events first: then ImGui knows where the picture is.
    for (int frames = 0; frames < 2 || context.has_waiting(); ++frames) {
        const PaneFrame frame = context.begin({500, 400, 1.0F}, {100.0F, 100.0F});
        all.push_back(picture_view(frame, "picture", PicturePlace(kBox, 400, 300, {}), nullptr));
        context.end();
        if (frames == 0) {
            context.take(events);
        }
    }
    return all;
}

TEST(PictureView, tells_press_drag_and_release_in_pixels_of_the_picture) {
    const auto all = gestures({MouseButtonEvent{MouseButton::left, true, 110.5F, 70.5F},
                               MouseDragEvent{.x = 120.5F, .y = 75.5F},
                               MouseButtonEvent{MouseButton::left, false, 120.5F, 75.5F}});
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[0].kind, PictureGesture::Kind::none);
    EXPECT_EQ(all[1].kind, PictureGesture::Kind::press);
    expect_near(all[1].pixel, {100.0, 50.0}, 1e-3);
    EXPECT_EQ(all[2].kind, PictureGesture::Kind::drag);
    expect_near(all[2].pixel, {110.0, 55.0}, 1e-3);
    EXPECT_EQ(all[3].kind, PictureGesture::Kind::release);
    expect_near(all[3].pixel, {110.0, 55.0}, 1e-3);
}

TEST(PictureView, zooms_by_the_wheel_and_only_over_the_picture) {
    const auto all = gestures({ScrollEvent{0.0F, 1.0F}});
    ASSERT_TRUE(all.back().zoom);
    EXPECT_DOUBLE_EQ(all.back().zoom->times, 1.25);
}

}  // namespace
}  // namespace raks::render
