#include "training/discovery/danced_beats.hpp"

#include <gtest/gtest.h>

namespace raks::motion::danced_beats_test {
namespace {

/// Beats every half second from 1 s of the music on, in bars of four; the clip begins at 2.25 s.
DancedMusic music() {
    DancedMusic music;
    music.name = "song.mp3";
    music.duration = 20.0;
    music.offset = 2.25;
    for (int b = 0; b < 36; ++b) {
        music.beats.push_back({1.0 + 0.5 * b, b % 4 + 1});
    }
    return music;
}

TEST(DancedBeats, are_those_of_the_clip) {
    const auto beats = DancedBeats::within(music(), 10.0);
    ASSERT_TRUE(beats);
    EXPECT_NEAR(beats->interval(), 0.5, 1e-12);
    EXPECT_NEAR(beats->beats_after_nearest(0.25), 0.0, 1e-12);
    EXPECT_NEAR(beats->beats_after_nearest(0.35), 0.2, 1e-12);
    EXPECT_EQ(beats->between(0.3, 1.3), (std::vector<double>{0.75, 1.25}));
    const auto from = beats->beats_from(0.3, 8);
    ASSERT_TRUE(from);
    EXPECT_NEAR(from->first, 0.25, 1e-12);
    EXPECT_NEAR(from->second, 4.25, 1e-12);
    EXPECT_FALSE(beats->beats_from(10.0, 64));
    const std::vector<double> moments = {0.75, 1.25, 2.75};
    EXPECT_NEAR(beats->share_on_bar_lines(moments), 2.0 / 3.0, 1e-12);
}

TEST(DancedBeats, know_how_many_a_repeat_has) {
    const auto beats = DancedBeats::within(music(), 10.0);
    ASSERT_TRUE(beats);
    EXPECT_EQ(beats->whole_beats(4.1, {}, 4), 8);
    EXPECT_EQ(beats->whole_beats(2.0, {}, 4), 4);
    EXPECT_EQ(beats->whole_beats(2.5, {}, 4), 0);
    EXPECT_EQ(beats->whole_beats(2.5, 5, 4), 5);
    EXPECT_EQ(beats->whole_beats(1.5, {}, 3), 3);
}

TEST(DancedBeats, of_other_times_are_an_error) {
    DancedMusic late = music();
    late.offset = 100.0;
    const auto beats = DancedBeats::within(late, 10.0);
    ASSERT_FALSE(beats);
    EXPECT_EQ(beats.error().message,
              "no beats were heard in song.mp3 from 100.0 to 110.0 s; is --offset right?");
}

}  // namespace
}  // namespace raks::motion::danced_beats_test
