#include "audio/resample/resampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

constexpr SampleRate kTo(32'000);

std::vector<float> sine(SampleRate rate, double hertz, double seconds) {
    std::vector<float> samples(static_cast<std::size_t>(rate.hertz() * seconds));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<float>(
            std::sin(2.0 * M_PI * hertz * static_cast<double>(i) / rate.hertz()));
    }
    return samples;
}

std::vector<float> resampled(SampleRate from, const std::vector<float>& input, std::uint64_t seed) {
    Resampler resampler;
    EXPECT_TRUE(resampler.prepare(from, kTo));
    const CounterRandom random(seed);
    std::vector<float> out(4 * input.size() + 4096);
    std::size_t made = 0;
    std::uint64_t draw = 0;
    test::RealtimeScope scope;
    for (std::size_t at = 0; at < input.size();) {
        const std::size_t count =
            seed == 0 ? input.size() - at
                      : std::min<std::size_t>(1 + random.below(draw++, 600), input.size() - at);
        const auto progress =
            resampler.process(std::span(input).subspan(at, count), std::span(out).subspan(made));
        at += progress.taken;
        made += progress.made;
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    out.resize(made);
    return out;
}

TEST(Resampler, keeps_the_time_of_a_sine_at_every_rate) {
    for (const int hertz : {8'000, 11'025, 22'050, 32'000, 44'100, 48'000, 96'000, 192'000}) {
        const SampleRate from(hertz);
        const std::vector<float> out = resampled(from, sine(from, 440.0, 0.5), 0);
        const std::vector<float> expected = sine(kTo, 440.0, 0.5);
        ASSERT_GT(out.size(), 14'000U) << hertz;
        for (std::size_t i = 2'000; i < 14'000; ++i) {
            ASSERT_NEAR(out[i], expected[i], 2e-3) << hertz << " sample " << i;
        }
    }
}

TEST(Resampler, any_blocks_give_the_same_bits) {
    for (const int hertz : {8'000, 44'100, 48'000, 192'000}) {
        const SampleRate from(hertz);
        const std::vector<float> input = sine(from, 1234.5, 0.5);
        EXPECT_EQ(resampled(from, input, 0), resampled(from, input, 7)) << hertz;
    }
}

TEST(Resampler, says_how_late_its_output_is) {
    Resampler resampler;
    ASSERT_TRUE(resampler.prepare(SampleRate(48'000), kTo));
    EXPECT_GT(resampler.delay(), Nanos(0));
    EXPECT_LT(resampler.delay(), std::chrono::milliseconds(8));
    ASSERT_TRUE(resampler.prepare(kTo, kTo));
    EXPECT_EQ(resampler.delay(), Nanos(0));
}

}  // namespace
}  // namespace raks::audio
