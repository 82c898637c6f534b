#include "base/beat_grid.hpp"

#include <gtest/gtest.h>

namespace raks {
namespace {

BeatGrid grid_at(double anchor_seconds, double anchor_beat, double bpm) {
    BeatGrid grid;
    grid.anchor_time = stream_time_from_seconds(anchor_seconds);
    grid.anchor_beat = Beats(anchor_beat);
    grid.tempo = Bpm(bpm);
    return grid;
}

TEST(BeatGrid, time_of_is_the_inverse_of_beats_at) {
    for (const double bpm : {50.0, 97.3, 120.0, 230.0}) {
        const BeatGrid grid = grid_at(3'600.1234, 7'000.25, bpm);
        for (double beat = -40; beat < 20'000; beat += 13.37) {
            const double back = grid.beats_at(grid.time_of(Beats(beat))).count();
            ASSERT_NEAR(back, beat, 4e-9) << bpm;  // half a nanosecond at 230 BPM is 2e-9 beats
        }
    }
}

TEST(BeatGrid, a_tempo_jump_at_the_anchor_keeps_the_beat_there) {
    const BeatGrid before = grid_at(10.0, 20.0, 120.0);
    BeatGrid after = before;
    after.anchor_time = stream_time_from_seconds(12.5);
    after.anchor_beat = before.beats_at(after.anchor_time);
    after.tempo = Bpm(180.0);
    EXPECT_DOUBLE_EQ(after.beats_at(after.anchor_time).count(), 25.0);
    EXPECT_DOUBLE_EQ(after.beats_at(stream_time_from_seconds(13.5)).count(), 28.0);
}

TEST(BeatGrid, bar_position_counts_from_the_bar_origin_also_before_it) {
    BeatGrid grid = grid_at(0, 0, 120);
    grid.bar_origin = Beats(2);
    EXPECT_DOUBLE_EQ(grid.bar_position(Beats(2)), 0.0);
    EXPECT_DOUBLE_EQ(grid.bar_position(Beats(7.5)), 1.5);
    EXPECT_NEAR(grid.bar_position(Beats(-3)), 3.0, 1e-9);
    grid.beats_per_bar = 3;
    EXPECT_NEAR(grid.bar_position(Beats(4)), 2.0, 1e-9);
}

TEST(BeatGrid, rounding_just_before_a_bar_line_is_the_bar_line) {
    BeatGrid grid = grid_at(0, 0, 120);
    EXPECT_DOUBLE_EQ(grid.bar_position(Beats(4.0 - 1e-9)), 0.0);
    EXPECT_NEAR(grid.bar_position(Beats(4.0 - 1e-3)), 3.999, 1e-9);
}

}  // namespace
}  // namespace raks
