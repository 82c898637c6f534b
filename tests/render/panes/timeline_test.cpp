#include "render/panes/timeline.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace raks::render {
namespace {

constexpr Box kTimelineBox{10.0F, 20.0F, 400.0F, 100.0F};

TEST(Timeline, frames_and_places_are_inverse) {
    const Box frames = timeline_frames(kTimelineBox);
    for (const std::size_t count : {1U, 7U, 60U, 20000U}) {
        for (const std::size_t frame : {std::size_t{0}, count / 3, count - 1}) {
            EXPECT_EQ(timeline_frame(frames, timeline_x(frames, frame, count), count), frame)
                << count;
        }
    }
    EXPECT_EQ(timeline_frame(frames, -1000.0F, 60), 0U);
    EXPECT_EQ(timeline_frame(frames, 1e6F, 60), 59U);
}

TEST(Timeline, goes_to_the_frame_that_is_pressed_and_follows_the_drag) {
    PaneContext context;
    const std::array<double, 60> curve{1.0, std::numeric_limits<double>::quiet_NaN(), 3.0};
    const std::vector<TimelineMark> marks = {{3, 9, 0, palette::kRed}};
    const TimelineState state{
        .frame_count = 60, .curve = curve, .title = "error", .marks = marks, .rows = {"flags"}};
    const Box frames = timeline_frames(kTimelineBox);
    const float x = timeline_x(frames, 20, 60);
    const float farther = timeline_x(frames, 41, 60);
    std::vector<std::optional<std::size_t>> asked;
    for (int i = 0; i < 2 || context.has_waiting(); ++i) {
        const PaneFrame frame = context.begin({500, 200, 1.0F}, {farther, 50.0F});
        asked.push_back(timeline(frame, kTimelineBox, state));
        context.end();
        if (i == 0) {
            context.take(
                std::vector<WindowEvent>{MouseButtonEvent{MouseButton::left, true, x, 50.0F},
                                         MouseDragEvent{.x = farther, .y = 50.0F}});
        }
    }
    EXPECT_EQ(asked, (std::vector<std::optional<std::size_t>>{std::nullopt, 20U, 41U}));
}

}  // namespace
}  // namespace raks::render
