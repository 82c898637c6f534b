#include "engine/live/clock_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace raks::engine {
namespace {

HostTime host(double seconds) { return HostTime(nanos_from_seconds(1'000.0 + seconds)); }

/// Feeds callbacks of 256 frames at 48 kHz by a crystal `drift` fast, each late by exponential
/// jitter of mean `jitter`.
ClockMap settled_map(double drift, double jitter, double seconds) {
    ClockMap map;
    const CounterRandom random(3);
    const double block = 256.0 / 48'000.0;
    for (int i = 0; i * block < seconds; ++i) {
        const double late = -jitter * std::log(1.0 - random.uniform(static_cast<std::uint64_t>(i)));
        map.update(stream_time_from_seconds(i * block), host(i * block / (1.0 + drift) + late));
    }
    return map;
}

TEST(ClockMap, follows_a_crystal_that_is_100_ppm_fast) {
    const ClockMap map = settled_map(1e-4, 0.0, 60.0);
    const double stream = to_seconds(map.line().stream_at(host(60.5)));
    EXPECT_NEAR(stream, 60.5 * (1.0 + 1e-4), 1e-4);
}

TEST(ClockMap, averages_the_lateness_of_callbacks) {
    const ClockMap map = settled_map(0.0, 0.001, 30.0);
    // The mean lateness (1 ms) stays as an offset; its scatter (sd 1 ms) is averaged away.
    EXPECT_NEAR(to_seconds(map.line().stream_at(host(30.2))), 30.2 - 0.001, 5e-4);
}

TEST(ClockMap, a_jump_starts_anew_at_once) {
    ClockMap map = settled_map(0.0, 0.0, 5.0);
    map.update(stream_time_from_seconds(9.0), host(5.0));
    EXPECT_NEAR(to_seconds(map.line().stream_at(host(5.1))), 9.1, 1e-6);
}

TEST(ClockMap, after_an_xrun_a_step_is_followed_within_half_a_second) {
    for (const double step : {-0.03, -0.005, 0.03}) {
        ClockMap map = settled_map(0.0, 0.0, 20.0);
        map.loosen();
        for (double t = 20.0; t < 20.5; t += 256.0 / 48'000.0) {
            map.update(stream_time_from_seconds(t), host(t + step));
        }
        EXPECT_NEAR(to_seconds(map.line().stream_at(host(20.5))), 20.5 - step, 0.002) << step;
    }
}

TEST(ClockMap, stream_time_stands_still_while_stopped) {
    ClockMap map = settled_map(0.0, 0.0, 5.0);
    map.stop(stream_time_from_seconds(5.0));
    EXPECT_EQ(map.line().stream_at(host(50.0)), stream_time_from_seconds(5.0));
    map.update(stream_time_from_seconds(5.0), host(60.0));
    EXPECT_NEAR(to_seconds(map.line().stream_at(host(61.0))), 6.0, 1e-6);
}

TEST(ClockLine, host_at_is_the_inverse_of_stream_at) {
    const ClockLine line{stream_time_from_seconds(3), host(7), 1.0002, true};
    for (double t = -5; t < 50; t += 0.37) {
        const StreamTime stream = stream_time_from_seconds(t);
        EXPECT_LE(std::abs((line.stream_at(line.host_at(stream)) - stream).count()), 2);
    }
}

}  // namespace
}  // namespace raks::engine
