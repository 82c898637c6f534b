#include "engine/trials/click_train.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace raks::engine {
namespace {

using std::chrono::milliseconds;

constexpr SampleRate kClickRate(48'000);
constexpr HostTime kClickStart{std::chrono::seconds(100)};

/// Marks of a device that hands over blocks of 10 ms, frame 0 at `begin`.
BlockClock clock_from(HostTime begin, SampleRate rate, double seconds, Nanos heard_after) {
    std::vector<BlockClock::Mark> marks;
    const auto block = static_cast<std::int64_t>(rate.hertz() / 100);
    for (std::int64_t frame = 0; frame < std::llround(seconds * rate.hertz()); frame += block) {
        marks.push_back({frame, begin + heard_after + rate.time_of(frame).time_since_epoch()});
    }
    return {rate, std::move(marks)};
}

/// How the clicks come back.
struct Way {
    double seconds = 0.0;  ///< later than reported
    float gain = 1.0F;
    float noise = 0.0F;
    SampleRate rate = kClickRate;  ///< of the input
    int lost_clicks = 0;           ///< the first ones
};

Expected<MeasuredOffset> through(const Way& way, int clicks = 32) {
    const ClickTrain train = irregular_clicks(clicks);
    // The recording begins 0.25 s before the music; both devices say a latency of their own.
    constexpr Nanos kBefore = milliseconds(250);
    constexpr Nanos kOut = milliseconds(40);
    constexpr Nanos kIn = milliseconds(-7);
    const double seconds = train.seconds + 3.0;
    ClickTrain heard = train;
    heard.clicks.erase(heard.clicks.begin(), heard.clicks.begin() + way.lost_clicks);
    const std::vector<float> sound = sound_of(heard, way.rate);
    std::vector<float> samples(static_cast<std::size_t>(seconds * way.rate.hertz()));
    const auto shift =
        std::llround((to_seconds(kBefore + kOut - kIn) + way.seconds) * way.rate.hertz());
    constexpr CounterRandom kNoise(7);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto from = static_cast<std::int64_t>(i) - shift;
        samples[i] = way.noise * static_cast<float>(kNoise.uniform(i) - 0.5);
        if (from >= 0 && from < std::ssize(sound)) {
            samples[i] += way.gain * sound[static_cast<std::size_t>(from)];
        }
    }
    return loop_offset(
        train,
        clock_from(kClickStart, kClickRate, train.seconds, kOut),
        {clock_from(kClickStart - kBefore, way.rate, seconds, kIn), std::move(samples)});
}

TEST(LoopOffset, is_the_way_that_no_device_reports) {
    for (const double seconds : {-0.05, 0.0, 1.0 / 48'000.0, 0.0123, 0.3005, 0.75, 1.99}) {
        const auto offset = through({.seconds = seconds});
        ASSERT_TRUE(offset) << seconds << ": " << offset.error().message;
        EXPECT_NEAR(to_seconds(offset->offset), seconds, 5e-5);
        EXPECT_EQ(offset->count, 32);
    }
}

TEST(LoopOffset, is_found_in_noise_and_at_another_rate) {
    const auto soft = through({.seconds = 0.21, .gain = 0.05F, .noise = 0.05F});
    ASSERT_TRUE(soft) << soft.error().message;
    EXPECT_NEAR(to_seconds(soft->offset), 0.21, 2e-4);
    const auto other = through({.seconds = 0.4, .rate = SampleRate(44'100)});
    ASSERT_TRUE(other) << other.error().message;
    EXPECT_NEAR(to_seconds(other->offset), 0.4, 1e-4);
    const auto late = through({.seconds = 0.4, .lost_clicks = 5});
    ASSERT_TRUE(late) << late.error().message;
    EXPECT_NEAR(to_seconds(late->offset), 0.4, 1e-4);
    EXPECT_EQ(late->count, 27);
}

TEST(LoopOffset, is_refused_where_too_little_came_back) {
    const auto silence = through({.gain = 0.0F});
    ASSERT_FALSE(silence);
    EXPECT_EQ(silence.error().message,
              "only 0 of 32 clicks came back: turn the loudspeaker up, or bring the microphone "
              "nearer");
    EXPECT_FALSE(through({.gain = 0.0F, .noise = 0.5F}));
    EXPECT_FALSE(through({.lost_clicks = 20}));
}

/// Clicks every 0.8 s, and a tap to each from the second on, `late` plus up to `spread` after it.
Expected<MeasuredOffset> tapped(double late, double spread, int taps) {
    std::vector<HostTime> clicks;
    std::vector<HostTime> times;
    constexpr CounterRandom kSpread(3);
    for (int i = 0; i < 32; ++i) {
        clicks.push_back(kClickStart + nanos_from_seconds(0.8 * i));
        if (i >= 1 && i <= taps) {
            const double off = spread * (kSpread.uniform(static_cast<std::uint64_t>(i)) - 0.5);
            times.push_back(clicks.back() + nanos_from_seconds(late + off));
        }
    }
    return tap_offset(clicks, times);
}

TEST(TapOffset, is_the_median_of_the_taps) {
    for (const double late : {-0.2, 0.0, 0.12, 0.35}) {
        const auto offset = tapped(late, 0.08, kTaps);
        ASSERT_TRUE(offset) << offset.error().message;
        EXPECT_NEAR(to_seconds(offset->offset), late, 0.02);
    }
}

TEST(TapOffset, is_refused_where_taps_are_few_or_wide_apart) {
    const auto few = tapped(0.1, 0.0, kTaps - 1);
    ASSERT_FALSE(few);
    EXPECT_EQ(few.error().message, "16 taps to the clicks are needed, 15 came");
    const auto wide = tapped(0.1, 0.3, 30);
    ASSERT_FALSE(wide);
    EXPECT_NE(wide.error().message.find("apart (quartiles; 60 at most)"), std::string::npos)
        << wide.error().message;
    EXPECT_FALSE(tap_offset({}, {}));
}

}  // namespace
}  // namespace raks::engine
