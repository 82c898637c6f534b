#include "training/cells/grid_music.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/random.hpp"

namespace raks::motion::grid_music_test {
namespace {

/// Cues with an impulse at each of these moments, of a body that always moves.
GridCues cues_with(const std::vector<double>& times, double seconds) {
    GridCues cues;
    const auto rows = static_cast<std::size_t>(seconds * kCueRate) + 1;
    cues.impulse.resize(rows, -0.1);
    cues.body_speed.resize(rows, 1.0);
    for (const double time : times) {
        cues.impulse[cues.row_at(time)] = 3.0;
    }
    return cues;
}

TEST(GridMusic, is_laid_where_its_beats_meet_the_landings) {
    // Beats that are not even, so that there is one place only.
    const CounterRandom random(5);
    DancedMusic music;
    double at = 0.4;
    for (std::uint64_t i = 0; i < 120; ++i) {
        music.beats.push_back({at, static_cast<int>(i % 4) + 1});
        at += 0.45 + 0.1 * random.uniform(i);
    }
    constexpr double kOffset = 12.34;
    std::vector<double> landings;
    for (const MusicBeat& beat : music.beats) {
        if (beat.seconds > kOffset && beat.seconds < kOffset + 20.0) {
            landings.push_back(beat.seconds - kOffset);
        }
    }
    const GridCues cues = cues_with(landings, 20.0);
    const MusicOffset found = find_offset(cues, music);
    EXPECT_NEAR(found.seconds, kOffset, 0.02);
    EXPECT_GT(found.strength, 4.0);
    music.offset = found.seconds;
    const TakeGrid grid = grid_of_music("take", cues, music);
    ASSERT_GE(grid.beats.size(), landings.size() - 1);
    for (std::size_t i = 1; i < grid.beats.size(); ++i) {
        EXPECT_GT(grid.beats[i].time, grid.beats[i - 1].time);
        EXPECT_NE(grid.beats[i].half, grid.beats[i - 1].half);
    }
    EXPECT_FALSE(grid.beats.back().is_used) << "it ends behind the clip";
}

TEST(GridMusic, of_an_even_song_lies_within_a_beat_of_the_start) {
    DancedMusic music;
    std::vector<double> landings;
    for (int i = 0; i < 200; ++i) {
        music.beats.push_back({0.5 * i, i % 4 + 1});
    }
    for (int i = 0; i < 38; ++i) {
        landings.push_back(0.2 + 0.5 * i);
    }
    const MusicOffset found = find_offset(cues_with(landings, 20.0), music);
    EXPECT_LT(std::abs(found.seconds), 0.5);
    EXPECT_NEAR(std::remainder(found.seconds + 0.2, 0.5), 0.0, 0.03);
    EXPECT_EQ(find_offset(cues_with(landings, 20.0), {}).strength, 0.0);
}

}  // namespace
}  // namespace raks::motion::grid_music_test
