#include "engine/outputs/beat_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(BeatSchedule, keeps_the_newest_events_where_they_are_too_many) {
    BeatSchedule schedule;
    MusicState state;
    for (int i = 0; i < 20; ++i) {
        state.event = {MusicEvent::Kind::entry, at(i)};
        schedule.take(state);
    }
    EXPECT_EQ(take_due(schedule, 100.0).size(), 8U);
}

}  // namespace
}  // namespace raks::engine
