#include "motion/dance/cell_listener.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/motion/dance/stage.hpp"

namespace raks::motion {
namespace {

using Kind = MusicEvent::Kind;

/// A listener with what it needs of a dancer that began on the first downbeat of music of 120 BPM.
struct Listening {
    DanceMetre metre{Bpm(120.0), 4};
    DancePhase phase;
    MannerOfMusic manner;
    Phrases phrases;
    CellListener listener;
    HopIndex hop = 0;
    bool has_dynamics = true;

    CellMusic go_on(MusicState music) {
        if (hop == 0) {
            phase.start(music.grid, Beats(0.0), metre, music.time);
            phrases.begin(music.grid, music.time);
        }
        phrases.advance(music);
        manner.hear(music.event);
        manner.advance(music);
        listener.hear(music);
        static_cast<void>(phase.advance(music.grid, metre, Beats(1e9), music.time));
        ++hop;
        return listener.asked(music, {phase, manner, phrases, 1, has_dynamics});
    }
    MusicState playing() const {
        MusicState music = test::sure_state(hop, test::steady_grid(120.0));
        music.part = MusicPart::playing;
        return music;
    }
};

TEST(CellListener, asks_for_calm_cells_where_the_music_gives_less) {
    Listening dancer;
    CellMusic full;
    CellMusic calm;
    for (int hop = 0; hop < 4'000; ++hop) {
        MusicState music = dancer.playing();
        const bool is_calm = hop / 800 % 2 == 1;
        music.energy.now = music.energy.lately = is_calm ? 0.4F : 0.6F;
        (is_calm ? calm : full) = dancer.go_on(music);
    }
    EXPECT_LT(calm.energy, 0.4);
    EXPECT_GT(full.energy, 0.6);
    MusicState music = dancer.playing();
    music.part = MusicPart::breakdown;
    EXPECT_LE(dancer.go_on(music).energy, 0.25);
}

TEST(CellListener, foresees_a_drop_and_a_stop_of_a_known_song) {
    Listening dancer;
    for (int hop = 0; hop < 1'000; ++hop) {
        static_cast<void>(dancer.go_on(dancer.playing()));
    }
    MusicState music = dancer.playing();
    music.ahead.is_known = true;
    music.ahead.events[0] = {Kind::drop, time_of_hop(1'200)};
    EXPECT_EQ(dancer.go_on(music).drop_at, 24.0);
    music = dancer.playing();
    music.ahead.is_known = true;
    music.ahead.events[0] = {Kind::stop, time_of_hop(1'210)};
    EXPECT_EQ(dancer.go_on(music).rests_at, 24.0);
    EXPECT_FALSE(dancer.go_on(dancer.playing()).has_come_in);
}

TEST(CellListener, a_drop_that_is_not_foreseen_is_answered_at_once) {
    Listening dancer;
    for (int hop = 0; hop < 1'000; ++hop) {
        static_cast<void>(dancer.go_on(dancer.playing()));
    }
    MusicState music = dancer.playing();
    music.event = {Kind::drop, music.time};
    const CellMusic asked = dancer.go_on(music);
    EXPECT_TRUE(asked.has_come_in);
    EXPECT_EQ(asked.drop_at, 20.0);
}

TEST(CellListener, some_phrases_end_in_a_rest_two_beats_before_the_next) {
    Listening dancer;
    int ends = 0;
    int hops = 0;
    for (int hop = 0; hop < 40'000; ++hop) {
        const CellMusic asked = dancer.go_on(dancer.playing());
        ASSERT_TRUE(asked.anew_at);
        EXPECT_EQ(std::fmod(*asked.anew_at, 32.0), 0.0);
        ++hops;
        if (asked.rests_at) {
            const double into = std::fmod(*asked.rests_at, 32.0);
            EXPECT_TRUE(into == 14.0 || into == 30.0) << into;
            ends += into == 30.0 ? 1 : 0;
        }
    }
    EXPECT_GT(ends, hops / 4);
    EXPECT_LT(ends, 9 * hops / 10);
}

TEST(CellListener, tells_the_bars_of_a_known_song) {
    Listening dancer;
    CellMusic asked;
    for (int hop = 0; hop < 3'000; ++hop) {
        MusicState music = dancer.playing();
        music.ahead.is_known = true;
        music.ahead.bar = hop / 200;  // 2 s
        music.ahead.repeats = {static_cast<std::int16_t>(hop / 200 - 3), -1, -1, -1};
        asked = dancer.go_on(music);
        if (hop % 200 > 50) {
            ASSERT_TRUE(asked.song) << hop;
            EXPECT_EQ(asked.song->bar, hop / 200);
            EXPECT_EQ(asked.song->begins, 4.0 * asked.song->bar);
            EXPECT_EQ(asked.song->beats, 4);
            EXPECT_EQ(asked.song->repeats[0], hop / 200 - 3);
        }
    }
    EXPECT_FALSE(dancer.go_on(dancer.playing()).song) << "another song, which is not known";
}

TEST(CellListener, without_dynamics_hears_energy_alone) {
    Listening dancer;
    dancer.has_dynamics = false;
    for (int hop = 0; hop < 4'000; ++hop) {
        MusicState music = dancer.playing();
        if (hop == 3'000) {
            music.event = {Kind::drop, music.time};
        }
        const CellMusic asked = dancer.go_on(music);
        EXPECT_FALSE(asked.rests_at);
        EXPECT_FALSE(asked.drop_at);
        EXPECT_FALSE(asked.has_come_in);
    }
}

}  // namespace
}  // namespace raks::motion
