#include "engine/show/clip_course.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace raks::engine {
namespace {

/// Music at a tempo whose first 1 lies at `first`, known from the start.
MusicState music_at(double bpm, double first = 0.0) {
    MusicState music;
    music.grid.tempo = Bpm(bpm);
    music.grid.anchor_time = stream_time_from_seconds(first);
    music.grid.confidence = 0.9F;
    return music;
}

/// Places of the clip by hop, from 0 to `seconds`.
std::vector<std::optional<double>> course_of(ClipCourse& course,
                                             const MusicState& music,
                                             double seconds) {
    std::vector<std::optional<double>> places;
    for (HopIndex hop = 0; to_seconds(time_of_hop(hop) - StreamTime{}) < seconds; ++hop) {
        places.push_back(course.advance(time_of_hop(hop), music));
    }
    return places;
}

std::optional<double> at(const std::vector<std::optional<double>>& places, double seconds) {
    return places[static_cast<std::size_t>(std::lround(100.0 * seconds))];
}

TEST(ClipCourse, with_its_song_runs_at_its_own_rate_from_the_offset_on) {
    ClipCourse course({.seconds = 3.0}, {.sync = ClipSync::song, .offset = 2.0});
    course.set_song_start(0.5);
    const auto places = course_of(course, music_at(133.0), 10.0);
    EXPECT_FALSE(at(places, 1.49));
    EXPECT_NEAR(at(places, 1.5).value_or(-1.0), 0.0, 1e-9);
    EXPECT_NEAR(at(places, 3.25).value_or(-1.0), 1.75, 1e-9);
    EXPECT_FALSE(at(places, 4.6)) << "over";
    EXPECT_FALSE(at(places, 9.0)) << "never again";
    course.set_song_start(20.0);
    EXPECT_FALSE(course.advance(time_of_hop(1'000), music_at(133.0))) << "somebody sought";
    course.set_song_start(-9.0);
    EXPECT_NEAR(course.advance(time_of_hop(1'200), music_at(133.0)).value_or(-1.0), 1.0, 1e-9);
}

TEST(ClipCourse, begins_on_a_1_and_stays_on_the_beat) {
    for (const double bpm : {92.0, 120.0, 155.0}) {
        // 8 beats at 120 BPM.
        ClipCourse course({.seconds = 4.0, .bpm = 120.0, .do_ends_meet = true}, {});
        const auto places = course_of(course, music_at(bpm, 0.7), 30.0);
        EXPECT_FALSE(at(places, 0.69)) << bpm;
        for (double time = 2.0; time < 29.0; time += 0.37) {
            const double beats = (time - 0.7) * bpm / 60.0;
            const auto place = at(places, std::round(100.0 * time) / 100.0);
            ASSERT_TRUE(place) << bpm << " at " << time;
            const double off = std::remainder(*place / 0.5 - beats, 8.0);
            EXPECT_LT(std::abs(off), 0.06) << bpm << " at " << time;
        }
    }
}

TEST(ClipCourse, dances_at_half_and_double_tempo) {
    for (const double bpm : {60.0, 240.0}) {
        ClipCourse course({.seconds = 40.0, .bpm = 120.0}, {});
        (void)course_of(course, music_at(bpm), 10.0);
        EXPECT_NEAR(course.rate(), 1.0, 1e-6) << bpm;
    }
}

TEST(ClipCourse, runs_at_its_own_rate_where_the_music_is_too_far_off) {
    // 0.725 or 1.45 times as fast.
    ClipCourse course({.seconds = 40.0, .bpm = 120.0}, {});
    (void)course_of(course, music_at(87.0), 10.0);
    EXPECT_EQ(course.rate(), 1.0);
}

TEST(ClipCourse, waits_for_the_next_phrase_where_its_ends_do_not_meet) {
    // 120 BPM: a bar lasts 2 s, a phrase 16.
    ClipCourse course({.seconds = 5.0, .bpm = 120.0}, {});
    const auto places = course_of(course, music_at(120.0, 1.0), 40.0);
    EXPECT_FALSE(at(places, 0.95));
    EXPECT_TRUE(at(places, 1.02));
    EXPECT_TRUE(at(places, 5.9));
    for (const double time : {6.1, 9.0, 16.9}) {
        EXPECT_FALSE(at(places, time)) << time;
    }
    EXPECT_NEAR(at(places, 17.5).value_or(-1.0), 0.5, 0.03);
    EXPECT_FALSE(at(places, 30.0));
    EXPECT_NEAR(at(places, 34.0).value_or(-1.0), 1.0, 0.03);
}

TEST(ClipCourse, loops_and_stops_as_it_is_told) {
    ClipCourse always({.seconds = 5.0, .bpm = 120.0}, {.loop = ClipLoop::always});
    const auto places = course_of(always, music_at(120.0, 1.0), 20.0);
    EXPECT_NEAR(at(places, 13.0).value_or(-1.0), 2.0, 0.03);
    ClipCourse never({.seconds = 5.0, .bpm = 120.0, .do_ends_meet = true},
                     {.loop = ClipLoop::never});
    const auto once = course_of(never, music_at(120.0, 1.0), 40.0);
    EXPECT_TRUE(at(once, 5.9));
    for (double time = 6.1; time < 39.0; time += 1.0) {
        EXPECT_FALSE(at(once, time)) << time;
    }
}

TEST(ClipCourse, begins_by_itself_where_there_is_no_beat) {
    ClipCourse course({.seconds = 5.0, .bpm = 120.0, .do_ends_meet = true}, {});
    const MusicState silence;
    const auto places = course_of(course, silence, 12.0);
    EXPECT_FALSE(at(places, 3.9));
    EXPECT_NEAR(at(places, 6.0).value_or(-1.0), 2.0, 0.02);
    EXPECT_NEAR(at(places, 10.0).value_or(-1.0), 1.0, 0.02);
    course.begin_anew();
    EXPECT_FALSE(course.advance(time_of_hop(0), silence));
}

// A tracker corrects itself all the time.
TEST(ClipCourse, never_jumps_where_the_beats_are_moved) {
    ClipCourse course({.seconds = 60.0, .bpm = 120.0}, {});
    double before = 0.0;
    for (HopIndex hop = 0; hop < 3'000; ++hop) {
        const double wave = std::sin(0.003 * static_cast<double>(hop));
        const MusicState music = music_at(124.0 + 2.0 * wave, 0.5 + 0.05 * wave);
        const auto place = course.advance(time_of_hop(hop), music);
        if (place && before > 0.0) {
            EXPECT_GT(*place, before) << hop;
            EXPECT_LT(*place - before, 0.0125) << hop;
        }
        before = place.value_or(0.0);
    }
}

}  // namespace
}  // namespace raks::engine
