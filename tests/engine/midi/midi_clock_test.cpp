#include "engine/midi/midi_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

constexpr double kRate = 48'000.0;
constexpr std::uint32_t kPeriod = 256;
constexpr int kClocks = 24;

HostTime host(double seconds) { return HostTime(nanos_from_seconds(100.0 + seconds)); }
double seconds_of(HostTime time) { return to_seconds(time - host(0.0)); }

/// Beats at a steady tempo whose count 1 is at `one`.
MidiClockBeats steady(double bpm, double one = 0.0) {
    MidiClockBeats beats;
    beats.anchor = host(one);
    beats.beats_per_second = bpm / 60.0;
    beats.is_followed = true;
    return beats;
}

/// A byte and the sample at which it was sent.
struct Sent {
    std::int64_t sample;
    std::uint8_t byte;
};

/// A clock that runs in periods, as a sound server calls it.
class RunningClock {
 public:
    /// Follows what `beats` gives for each period, for so long. `late`: how much later than its
    /// place a period seems to come, as servers measure it.
    void run(
        double length,
        const std::function<MidiClockBeats(double now)>& beats,
        const std::function<double()>& late = [] { return 0.0; }) {
        const auto end = samples_ + std::llround(length * kRate);
        for (; samples_ < end; samples_ += kPeriod) {
            const double now = static_cast<double>(samples_) / kRate;
            const auto messages = clock_.advance(beats(now), host(now + late()), kPeriod);
            for (const MidiClock::Message& message : messages) {
                EXPECT_LT(message.offset, kPeriod);
                sent_.push_back({samples_ + message.offset, message.byte});
            }
        }
    }
    void run(double length, const MidiClockBeats& beats) {
        run(length, [&](double) { return beats; });
    }

    [[nodiscard]] const std::vector<Sent>& sent() const { return sent_; }
    [[nodiscard]] std::vector<double> times_of(std::uint8_t byte) const {
        std::vector<double> times;
        for (const Sent& one : sent_) {
            if (one.byte == byte) {
                times.push_back(static_cast<double>(one.sample) / kRate);
            }
        }
        return times;
    }
    /// Samples between clocks.
    [[nodiscard]] std::vector<std::int64_t> intervals() const {
        std::vector<std::int64_t> all;
        std::optional<std::int64_t> last;
        for (const Sent& one : sent_) {
            if (one.byte == MidiClock::kClock) {
                if (last) {
                    all.push_back(one.sample - *last);
                }
                last = one.sample;
            }
        }
        return all;
    }

    MidiClock& clock() { return clock_; }

 private:
    MidiClock clock_{kRate};
    std::int64_t samples_ = 0;
    std::vector<Sent> sent_;
};

/// Starts and stops take turns, a start stands right before a clock, and stands on a count 1.
void expect_good_order(const std::vector<Sent>& sent) {
    bool is_running = false;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        if (i > 0) {
            EXPECT_GE(sent[i].sample, sent[i - 1].sample);
        }
        if (sent[i].byte == MidiClock::kStart) {
            EXPECT_FALSE(is_running);
            is_running = true;
            ASSERT_LT(i + 1, sent.size());
            EXPECT_EQ(sent[i + 1].byte, MidiClock::kClock);
            EXPECT_EQ(sent[i + 1].sample, sent[i].sample);
        } else if (sent[i].byte == MidiClock::kStop) {
            EXPECT_TRUE(is_running);
            is_running = false;
        }
    }
}

TEST(MidiClock, starts_on_a_count_1_and_ticks_24_times_a_beat) {
    RunningClock clock;
    clock.run(6.0, steady(120.0, 0.7));
    const auto starts = clock.times_of(MidiClock::kStart);
    ASSERT_EQ(starts.size(), 1U);
    // Bars of 2 s: 0.7, 2.7.
    EXPECT_NEAR(starts[0], 0.7, 1.0 / kRate);
    EXPECT_TRUE(clock.times_of(MidiClock::kStop).empty());
    const auto ticks = clock.times_of(MidiClock::kClock);
    const auto first =
        std::find_if(ticks.begin(), ticks.end(), [&](double time) { return time >= starts[0]; });
    for (auto tick = first; tick != ticks.end(); ++tick) {
        const double beats = (*tick - 0.7) * 2.0;
        EXPECT_NEAR(beats * kClocks, static_cast<double>(tick - first), 0.01);
    }
    expect_good_order(clock.sent());
}

TEST(MidiClock, on_a_held_tempo_no_interval_is_off_by_more_than_a_sample) {
    CounterRandom random(7);
    std::uint64_t draw = 0;
    for (const double bpm : {61.7, 90.0, 121.3, 128.0, 174.9, 229.0}) {
        RunningClock clock;
        // Periods that are measured with errors of 0.5 ms, and beats that follow drums by 2 ms.
        const auto late = [&] { return 0.5e-3 * (2.0 * random.uniform(draw++) - 1.0); };
        const auto beats = [&](double now) {
            MidiClockBeats held = steady(bpm, 0.3 + 2e-3 * std::sin(now));
            held.is_held = true;
            return held;
        };
        // Two bars, so that it has started.
        clock.run(480.0 / bpm + 1.0, beats, late);
        const std::size_t settled = clock.intervals().size();
        clock.run(20.0, beats, late);
        const auto intervals = clock.intervals();
        const double ideal = kRate * 60.0 / bpm / kClocks;
        for (std::size_t i = settled; i < intervals.size(); ++i) {
            EXPECT_NEAR(static_cast<double>(intervals[i]), ideal, 1.25) << bpm;
        }
        EXPECT_EQ(clock.times_of(MidiClock::kStart).size(), 1U);
    }
}

TEST(MidiClock, follows_beats_that_a_person_moves_while_the_tempo_is_held) {
    RunningClock clock;
    MidiClockBeats beats = steady(120.0);
    beats.is_held = true;
    clock.run(4.0, beats);
    beats.anchor += nanos_from_seconds(0.020);
    clock.run(4.0, beats);
    EXPECT_TRUE(clock.times_of(MidiClock::kStop).empty());
    const double last = clock.times_of(MidiClock::kClock).back();
    const double clocks = (last - 0.020) * 2.0 * kClocks;
    EXPECT_NEAR(std::remainder(clocks, 1.0) / (2.0 * kClocks), 0.0, 1.2e-3);
}

TEST(MidiClock, goes_on_at_the_last_tempo_while_no_beats_are_known) {
    RunningClock clock;
    clock.run(4.0, steady(100.0));
    MidiClockBeats unknown = steady(173.0, 0.33);
    unknown.is_followed = false;
    const std::size_t known = clock.intervals().size();
    clock.run(5.0, unknown);
    const auto intervals = clock.intervals();
    for (std::size_t i = known; i < intervals.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(intervals[i]), 1200.0, 1.0);
    }
    EXPECT_TRUE(clock.times_of(MidiClock::kStop).empty());
}

TEST(MidiClock, stops_at_a_jump_and_starts_at_the_next_count_1) {
    struct Jump {
        const char* name;
        MidiClockBeats behind;
    };
    MidiClockBeats three = steady(120.0, 0.5);
    three.beats_per_bar = 3;
    for (const auto& [name, behind] : {Jump{"phase", steady(120.0, 0.2)},
                                       Jump{"count", steady(120.0, 0.5)},
                                       Jump{"tempo", steady(60.0)},
                                       Jump{"metre", three}}) {
        RunningClock clock;
        clock.run(4.9, steady(120.0));
        clock.run(9.0, behind);
        const auto starts = clock.times_of(MidiClock::kStart);
        const auto stops = clock.times_of(MidiClock::kStop);
        ASSERT_EQ(starts.size(), 2U) << name;
        ASSERT_EQ(stops.size(), 1U) << name;
        EXPECT_NEAR(stops[0], 5.05, 0.35) << name;
        EXPECT_GT(starts[1], stops[0]) << name;
        const double bar = behind.beats_per_bar / behind.beats_per_second;
        const double from_one = std::remainder(starts[1] - seconds_of(behind.anchor), bar);
        EXPECT_NEAR(from_one, 0.0, 1e-3) << name;
        EXPECT_LT(starts[1] - stops[0], 2.0 * bar) << name;
        expect_good_order(clock.sent());
    }
}

TEST(MidiClock, says_stop_at_the_end_once) {
    RunningClock clock;
    EXPECT_TRUE(clock.clock().stop().empty());
    clock.run(3.0, steady(120.0));
    const auto messages = clock.clock().stop();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_EQ(messages[0].byte, MidiClock::kStop);
    EXPECT_TRUE(clock.clock().stop().empty());
}

TEST(MidiClock, half_and_twice_as_many_beats_have_clocks_of_their_own) {
    for (const int clocks : {12, 48}) {
        MidiClock clock(kRate, clocks);
        std::size_t ticks = 0;
        for (int period = 0; period < 10 * 1875 / 10; ++period) {
            const double now = period * (kPeriod / kRate);
            for (const auto& message : clock.advance(steady(120.0), host(now), kPeriod)) {
                ticks += message.byte == MidiClock::kClock ? 1U : 0U;
            }
        }
        EXPECT_NEAR(static_cast<double>(ticks), 10.0 * 2.0 * clocks, 1.0);
    }
}

/// Beats that a tracker moves at random: small steps all the time, jumps, other tempi, losses.
class WanderingBeats {
 public:
    explicit WanderingBeats(std::uint64_t seed) : random_(seed) {}

    MidiClockBeats at(double now) {
        if (now >= next_change_) {
            next_change_ = now + 0.5 + 6.0 * uniform();
            change(now);
        }
        // As it moves at each hop.
        beats_.anchor += nanos_from_seconds(0.3e-3 * (2.0 * uniform() - 1.0));
        return beats_;
    }

 private:
    double uniform() { return random_.uniform(draw_++); }
    void change(double now) {
        const double beat = beats_.beat_at(host(now));
        beats_.anchor = host(now);
        beats_.beat = beat;
        beats_.is_followed = uniform() < 0.85;
        beats_.is_held = uniform() < 0.3;
        const double kind = uniform();
        if (kind < 0.3) {
            beats_.beats_per_second *= 0.97 + 0.06 * uniform();
        } else if (kind < 0.5) {
            beats_.beats_per_second = 40.0 / 60.0 + 190.0 / 60.0 * uniform();
        } else if (kind < 0.7) {
            beats_.beat += 4.0 * uniform();
        } else if (kind < 0.8) {
            beats_.beats_per_bar = 2 + static_cast<int>(5.99 * uniform());
        }
        beats_.beats_per_second = std::clamp(beats_.beats_per_second, 40.0 / 60.0, 230.0 / 60.0);
    }

    CounterRandom random_;
    std::uint64_t draw_ = 0;
    double next_change_ = 0.0;
    MidiClockBeats beats_ = steady(120.0);
};

TEST(MidiClock, whatever_the_beats_do_clocks_are_even_and_none_is_skipped) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        WanderingBeats beats(seed);
        RunningClock clock;
        // The tempi that clocks may go by, and the beats as they were, period by period.
        std::vector<MidiClockBeats> told;
        clock.run(60.0, [&](double now) {
            told.push_back(beats.at(now));
            return told.back();
        });
        double followed = told.front().beats_per_second;
        std::size_t tempo_at = 0;
        std::optional<std::int64_t> last;
        for (const Sent& one : clock.sent()) {
            const auto period = static_cast<std::size_t>(one.sample / kPeriod);
            if (one.byte == MidiClock::kStart) {
                // A count 1 is within a millisecond.
                const MidiClockBeats& then = told[period];
                const double beat = then.beat_at(host(static_cast<double>(one.sample) / kRate));
                const double off = std::remainder(beat, then.beats_per_bar);
                EXPECT_LT(std::abs(off) / then.beats_per_second, 1e-3) << seed;
            }
            if (one.byte != MidiClock::kClock) {
                continue;
            }
            if (last) {
                const double interval = kRate / (followed * kClocks);
                const auto between = static_cast<double>(one.sample - *last);
                EXPECT_GE(between, 0.95 * interval - 1.0) << seed;
                EXPECT_LE(between, 1.05 * interval + 1.0) << seed;
                EXPECT_GE(between, 0.002 * kRate) << seed;
            }
            last = one.sample;
            // The interval behind a clock is by the tempo as followed at it.
            for (; tempo_at <= period; ++tempo_at) {
                followed = told[tempo_at].is_followed ? told[tempo_at].beats_per_second : followed;
            }
        }
        expect_good_order(clock.sent());
        EXPECT_GT(clock.times_of(MidiClock::kStart).size(), 2U);
    }
}

TEST(MidiClock, catches_up_evenly_after_lost_sound) {
    MidiClock clock(kRate);
    std::vector<double> ticks;
    std::int64_t counted = 0;  // samples of the clock's own
    for (int period = 0; period < 1875; ++period) {
        // 30 ms are lost after 4 s.
        const double lost = period >= 750 ? 0.030 : 0.0;
        const double now = period * (kPeriod / kRate) + lost;
        for (const auto& message : clock.advance(steady(120.0), host(now), kPeriod)) {
            if (message.byte == MidiClock::kClock) {
                ticks.push_back(static_cast<double>(counted + message.offset) / kRate);
            }
        }
        counted += kPeriod;
    }
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        EXPECT_NEAR(ticks[i] - ticks[i - 1], 0.5 / kClocks, 0.051 * 0.5 / kClocks);
    }
    const double clocks = (ticks.back() + 0.030) * 2.0 * kClocks;
    EXPECT_NEAR(std::remainder(clocks, 1.0) / (2.0 * kClocks), 0.0, 0.5e-3);
}

TEST(MidiClock, keeps_the_rules_of_the_audio_thread) {
    MidiClock clock(kRate);
    const MidiClockBeats beats = steady(120.0);
    test::RealtimeScope scope;
    std::size_t sent = 0;
    for (int period = 0; period < 500; ++period) {
        sent += clock.advance(beats, host(period * (kPeriod / kRate)), kPeriod).size();
    }
    sent += clock.stop().size();
    const auto found = scope.stop();
    EXPECT_TRUE(found.is_clean()) << found.describe();
    EXPECT_GT(sent, 100U);
}

}  // namespace
}  // namespace raks::engine
