#include "apps/grid/beat_strip.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/grid/strip_picture.hpp"

namespace raks::apps::beat_strip_test {
namespace {

motion::TakeGrid grid_of(const std::vector<double>& times, int first_half) {
    motion::TakeGrid grid{"take", {}};
    for (std::size_t i = 0; i < times.size(); ++i) {
        grid.beats.push_back({times[i], 1 + (static_cast<int>(i) + first_half - 1) % 2, true});
    }
    return grid;
}

std::vector<double> half_seconds(std::size_t count, double from) {
    std::vector<double> times;
    for (std::size_t i = 0; i < count; ++i) {
        times.push_back(from + 0.5 * static_cast<double>(i));
    }
    return times;
}

TEST(BeatStrip, has_eight_beats_and_their_half_beats_a_row) {
    const auto rows = strip_rows(grid_of(half_seconds(10, 1.0), 1));
    ASSERT_EQ(rows.size(), 2U);
    ASSERT_EQ(rows[0].size(), 16U);
    EXPECT_EQ(rows[0][15].time, 4.75);
    EXPECT_TRUE(rows[0][15].is_half);
    ASSERT_EQ(rows[1].size(), 3U) << "nothing follows the last beat";
    EXPECT_EQ(rows[1][2].beat, 9U);
    EXPECT_EQ(rows[1][2].column, 2);
}

TEST(BeatStrip, begins_a_row_with_the_first_half_of_the_bar) {
    const auto rows = strip_rows(grid_of(half_seconds(9, 1.0), 2));
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].front().column, 2);
    EXPECT_EQ(rows[0].size(), 14U);
    EXPECT_TRUE(rows[1].front().is_first);
}

TEST(BeatStrip, begins_a_row_behind_a_gap_and_where_halves_do_not_alternate) {
    auto times = half_seconds(4, 1.0);
    times.push_back(9.0);
    times.push_back(9.5);
    motion::TakeGrid grid = grid_of(times, 1);
    ASSERT_EQ(strip_rows(grid).size(), 2U);
    EXPECT_EQ(strip_rows(grid)[0].size(), 7U) << "no picture within the gap";
    grid.beats[2].half = 2;
    EXPECT_EQ(strip_rows(grid).size(), 4U);
    EXPECT_TRUE(strip_rows({"take", {}}).empty());
}

TEST(BeatStrip, places_moments_between_pictures) {
    const auto rows = strip_rows(grid_of(half_seconds(4, 1.0), 1));
    EXPECT_DOUBLE_EQ(strip_place(rows[0], 1.0), 0.5 * kStripTileWidth);
    EXPECT_DOUBLE_EQ(strip_place(rows[0], 1.125), 1.0 * kStripTileWidth);
    EXPECT_DOUBLE_EQ(strip_place(rows[0], 2.5), 6.5 * kStripTileWidth);
    EXPECT_LT(strip_place(rows[0], 0.5), 0.0);
}

TEST(BeatStrip, greys_beats_that_are_not_used_and_marks_landings) {
    motion::TakeGrid grid = grid_of(half_seconds(8, 1.0), 1);
    grid.beats[4].is_used = false;
    const auto rows = strip_rows(grid);
    render::PoseSheet bodies{kStripColumns * kStripTileWidth, kStripTileHeight, {}};
    for (int i = 0; i < bodies.width * bodies.height; ++i) {
        bodies.rgba.insert(bodies.rgba.end(), {200, 40, 40, 255});
    }
    motion::GridCues cues;
    cues.impulse.resize(400);
    cues.hips_height.resize(400, 1.0);
    cues.landings = {{2.0, motion::Side::left}};
    const render::PoseSheet page = paint_strip("take", rows, bodies, cues);
    EXPECT_EQ(page.height, kStripTitle + kStripRowHeight);
    const auto pixel = [&](double x, int y) {
        return &page.rgba[4U * static_cast<std::size_t>(y * page.width + static_cast<int>(x))];
    };
    const std::uint8_t* const used = pixel(3.5 * kStripTileWidth, kStripTitle + 70);
    EXPECT_GT(used[0], used[1]);
    const std::uint8_t* const unused = pixel(8.5 * kStripTileWidth, kStripTitle + 70);
    EXPECT_EQ(unused[0], unused[1]);
    EXPECT_LT(unused[0], used[0]);
    cues.landings.clear();
    EXPECT_NE(page.rgba, paint_strip("take", rows, bodies, cues).rgba);
}

}  // namespace
}  // namespace raks::apps::beat_strip_test
