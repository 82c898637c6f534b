#include "engine/outputs/beat_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/random.hpp"

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

StreamTime at(double time) { return StreamTime(nanos_from_seconds(time)); }

/// A state at `time`: beats at `first` seconds and on, danceable.
MusicState state_at(double time, double first, double bpm) {
    MusicState state;
    state.time = at(time);
    state.grid.anchor_time = at(first);
    state.grid.tempo = Bpm(bpm);
    state.grid.confidence = 0.9F;
    return state;
}

std::vector<Notice> take_due(BeatSchedule& schedule, double heard) {
    std::vector<Notice> due;
    while (const auto notice = schedule.next(at(heard))) {
        due.push_back(*notice);
    }
    return due;
}

TEST(BeatSchedule, tells_every_beat_when_it_is_heard_with_its_count) {
    BeatSchedule schedule;
    std::vector<int> counts;
    std::vector<std::int64_t> bars;
    for (int hop = 0; hop < 400; ++hop) {
        const double now = hop * 0.01;
        schedule.take(state_at(now, 0.0, 120.0));
        for (const Notice& notice : take_due(schedule, now)) {
            EXPECT_NEAR(to_seconds(notice.time.time_since_epoch()), now, 0.0101);
            EXPECT_EQ(notice.is_change, counts.empty());
            counts.push_back(notice.count);
            bars.push_back(notice.bar);
        }
    }
    EXPECT_EQ(counts, (std::vector<int>{1, 2, 3, 4, 1, 2, 3, 4}));
    EXPECT_EQ(bars, (std::vector<std::int64_t>{1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST(BeatSchedule, has_no_beats_while_nothing_can_be_danced_to) {
    BeatSchedule schedule;
    MusicState state = state_at(0.0, 0.0, 120.0);
    state.grid.confidence = 0.1F;
    schedule.take(state);
    EXPECT_TRUE(take_due(schedule, 3.0).empty());
    EXPECT_FALSE(schedule.next_time());
    // The beats before it can be are not made up for.
    schedule.take(state_at(3.2, 0.0, 120.0));
    const auto due = take_due(schedule, 3.55);
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(due[0].time, at(3.5));
    EXPECT_TRUE(due[0].is_change);
    EXPECT_EQ(due[0].bar, 1);
}

/// Whatever moves the grid by less than half a beat, each beat comes once: neighbours are between
/// half a beat and one and a half apart, and none is late.
TEST(BeatSchedule, neither_repeats_nor_skips_a_beat_when_the_grid_moves) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const CounterRandom random(seed, 1);
        BeatSchedule schedule;
        double first = 0.0;
        double bpm = 100.0 + 60.0 * random.uniform(0);
        const double period = 60.0 / bpm;
        std::optional<double> before;
        for (int hop = 0; hop < 3'000; ++hop) {
            const double now = hop * 0.01;
            if (hop % 37 == 0) {
                first +=
                    0.45 * period * (random.uniform(static_cast<std::uint64_t>(hop) + 1) - 0.5);
            }
            schedule.take(state_at(now, first, bpm));
            for (const Notice& notice : take_due(schedule, now)) {
                const double time = to_seconds(notice.time.time_since_epoch());
                EXPECT_LE(time, now) << "seed " << seed;
                if (before) {
                    EXPECT_GE(time - *before, 0.5 * period - 1e-6) << "seed " << seed;
                    EXPECT_LE(time - *before, 1.5 * period + 1e-6) << "seed " << seed;
                }
                before = time;
            }
        }
        EXPECT_EQ(schedule.missed(), 0U);
    }
}

TEST(BeatSchedule, marks_a_beat_that_does_not_follow_the_one_before) {
    BeatSchedule schedule;
    schedule.take(state_at(0.0, 0.0, 120.0));
    EXPECT_EQ(take_due(schedule, 0.0).size(), 1U);
    EXPECT_FALSE(take_due(schedule, 0.5).at(0).is_change);
    schedule.take(state_at(0.6, 0.2, 120.0));  // 0.2 s later
    EXPECT_TRUE(take_due(schedule, 1.2).at(0).is_change);
    schedule.take(state_at(1.3, 0.2, 150.0));  // another tempo
    EXPECT_TRUE(take_due(schedule, 1.9).at(0).is_change) << "though the beat at 1.4 s was missed";
}

TEST(BeatSchedule, passes_over_beats_that_nobody_asked_for_in_time) {
    BeatSchedule schedule;
    schedule.take(state_at(0.0, 0.0, 120.0));
    const auto due = take_due(schedule, 10.1);
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(due[0].time, at(10.0));
    EXPECT_EQ(schedule.missed(), 20U);
}

TEST(BeatSchedule, tells_events_in_their_order_among_the_beats) {
    BeatSchedule schedule;
    MusicState state = state_at(0.0, 0.0, 120.0);
    state.event = {MusicEvent::Kind::drop, at(0.75)};
    schedule.take(state);
    state.event = {MusicEvent::Kind::breakdown, at(0.25)};
    schedule.take(state);
    EXPECT_EQ(schedule.next_time(), at(0.0));
    EXPECT_EQ(take_due(schedule, 0.0).size(), 1U);
    EXPECT_EQ(schedule.next_time(), at(0.25));
    const auto due = take_due(schedule, 0.74);
    ASSERT_EQ(due.size(), 2U);
    EXPECT_EQ(due[0].event, MusicEvent::Kind::breakdown);
    EXPECT_EQ(due[1].kind, Notice::Kind::beat);
    EXPECT_EQ(take_due(schedule, 0.75).at(0).event, MusicEvent::Kind::drop);
}

TEST(BeatSchedule, tells_accents_among_them) {
    BeatSchedule schedule;
    MusicState state = state_at(0.0, 0.0, 120.0);
    state.accent = {.time = at(0.2), .strength = 0.5F, .band = MusicAccent::Band::low};
    schedule.take(state);
    EXPECT_EQ(take_due(schedule, 0.19).size(), 1U);
    const auto due = take_due(schedule, 0.2);
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(due[0].kind, Notice::Kind::accent);
    EXPECT_EQ(due[0].accent.strength, 0.5F);
}

TEST(BeatSchedule, goes_on_while_a_person_holds_the_tempo) {
    BeatSchedule schedule;
    MusicState state = state_at(0.0, 0.0, 120.0);
    state.grid.confidence = 0.0F;
    state.is_tempo_held = true;
    schedule.take(state);
    EXPECT_EQ(take_due(schedule, 0.5).size(), 1U);
}

TEST(BeatSchedule, has_half_the_beats_on_odd_counts_and_tells_the_others_for_their_bars) {
    for (const int beats_per_bar : {3, 4}) {
        BeatSchedule schedule(BeatSchedule::Pace::half);
        std::string paced;
        for (int hop = 0; hop < 600; ++hop) {
            MusicState state = state_at(hop * 0.01, 0.0, 120.0);
            state.grid.beats_per_bar = beats_per_bar;
            schedule.take(state);
            for (const Notice& notice : take_due(schedule, hop * 0.01)) {
                EXPECT_TRUE(notice.is_counted);
                EXPECT_EQ(notice.paced_tempo.bpm(), 60.0);
                EXPECT_EQ(notice.tempo.bpm(), 120.0);
                paced += notice.is_paced ? std::to_string(notice.count) : "-";
            }
        }
        EXPECT_EQ(paced, beats_per_bar == 4 ? "1-3-1-3-1-3-" : "1-3-2-1-3-2-");
    }
}

/// Whatever moves the grid: between two beats there is one more at most, and neither is near.
TEST(BeatSchedule, has_twice_the_beats_with_one_half_way_to_the_next) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const CounterRandom random(seed, 2);
        BeatSchedule schedule(BeatSchedule::Pace::twice);
        double first = 0.0;
        std::optional<Notice> before;
        int halves = 0;
        int beats = 0;
        for (int hop = 0; hop < 3'000; ++hop) {
            const double now = hop * 0.01;
            if (hop % 61 == 0) {  // once in a beat at most
                first += 0.2 * (random.uniform(static_cast<std::uint64_t>(hop)) - 0.5);
            }
            schedule.take(state_at(now, first, 120.0));
            for (const Notice& notice : take_due(schedule, now)) {
                EXPECT_TRUE(notice.is_paced);
                EXPECT_EQ(notice.paced_tempo.bpm(), 240.0);
                ++(notice.is_counted ? beats : halves);
                if (before) {
                    EXPECT_TRUE(notice.is_counted || before->is_counted) << "seed " << seed;
                    EXPECT_GE(to_seconds(notice.time - before->time), 0.12) << "seed " << seed;
                }
                before = notice;
            }
        }
        EXPECT_GE(beats, 55) << "seed " << seed;
        EXPECT_GE(halves, beats - 3) << "seed " << seed;
    }
}

TEST(BeatSchedule, keeps_the_newest_events_where_they_are_too_many) {
    BeatSchedule schedule;
    MusicState state;
    for (int i = 0; i < 40; ++i) {
        state.event = {MusicEvent::Kind::entry, at(i)};
        schedule.take(state);
    }
    EXPECT_EQ(take_due(schedule, 100.0).size(), 32U);
}

}  // namespace
}  // namespace raks::engine
