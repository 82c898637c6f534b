#include "motion/dance/dynamics/phrases.hpp"

#include <gtest/gtest.h>

#include "tests/motion/dance/stage.hpp"

namespace raks::motion::phrases_test {
namespace {

// 120 BPM: a bar lasts 2 s, a phrase 16 s.
MusicState music_at(HopIndex hop) { return test::sure_state(hop, test::steady_grid(120.0)); }

TEST(Phrases, have_eight_bars) {
    Phrases phrases;
    phrases.begin(music_at(0).grid, music_at(0).time);
    for (HopIndex hop = 0; hop < 4000; ++hop) {
        phrases.advance(music_at(hop));
        const double bars = static_cast<double>(hop) / 200.0;
        ASSERT_EQ(phrases.number(), static_cast<std::uint64_t>((bars + 1e-9) / 8.0)) << hop;
        ASSERT_NEAR(phrases.bar(), bars - 8.0 * static_cast<double>(phrases.number()), 1e-6);
    }
}

TEST(Phrases, are_the_same_whichever_bar_line_the_grid_counts_from) {
    Phrases phrases;
    phrases.begin(music_at(0).grid, music_at(0).time);
    for (HopIndex hop = 0; hop < 2000; ++hop) {
        MusicState music = music_at(hop);
        music.grid.bar_origin = Beats(4.0 * static_cast<double>(hop / 200));
        phrases.advance(music);
    }
    EXPECT_EQ(phrases.number(), 1U);
    EXPECT_NEAR(phrases.bar(), 1.995, 1e-6);
}

TEST(Phrases, begin_at_the_nearest_bar_line_and_anew_with_a_drop) {
    Phrases phrases;
    phrases.begin(music_at(0).grid, music_at(190).time);  // 0.1 s before the second bar
    phrases.advance(music_at(250));
    EXPECT_NEAR(phrases.bar(), 0.25, 1e-6);
    MusicState drop = music_at(1010);
    drop.event = {MusicEvent::Kind::drop, music_at(1000).time};
    phrases.advance(drop);
    EXPECT_NEAR(phrases.bar(), 0.05, 1e-6);
}

TEST(Phrases, a_grid_that_moves_a_little_begins_no_other_phrase) {
    Phrases phrases;
    phrases.begin(music_at(0).grid, music_at(0).time);
    for (HopIndex hop = 0; hop < 1400; ++hop) {
        MusicState music = music_at(hop);
        music.grid.anchor_beat = music.grid.anchor_beat + Beats(hop % 2 == 0 ? 0.05 : -0.05);
        phrases.advance(music);
    }
    EXPECT_LE(phrases.number(), 1U) << "the first hop lies before the phrase by a hair";
}

}  // namespace
}  // namespace raks::motion::phrases_test
