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
    // 11,025, 37,800 and 44,099 Hz stand in no simple ratio to 32 kHz.
    for (const int hertz :
         {8'000, 11'025, 22'050, 32'000, 37'800, 44'099, 44'100, 48'000, 96'000, 192'000}) {
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

/// Level in dB of what a sine of amplitude 1 becomes, against its own, in the steady part. Two
/// channels are converted by libspeexdsp, one by our own filter where the rates allow it.
double level_after(SampleRate from, SampleRate to, double hertz, int channels) {
    const std::vector<float> input = sine(from, hertz, 0.4);
    std::vector<float> frames;
    for (const float sample : input) {
        frames.insert(frames.end(), static_cast<std::size_t>(channels), sample);
    }
    Resampler resampler;
    EXPECT_TRUE(resampler.prepare(from, to, channels));
    std::vector<float> out(frames.size() * 5);
    const std::size_t made = resampler.process(frames, out).made;
    double energy = 0.0;
    const std::size_t first = made / 4;
    const std::size_t end = 3 * made / 4;
    for (std::size_t i = first; i < end; ++i) {
        const auto sample = static_cast<double>(out[i * static_cast<std::size_t>(channels)]);
        energy += sample * sample;
    }
    return 10.0 * std::log10(2.0 * energy / static_cast<double>(end - first) + 1e-30);
}

// In shares of the lower rate's band. What lies above it comes back as an alias, or not at all.
TEST(Resampler, passes_and_stops_what_libspeexdsp_does) {
    constexpr int kRates[][2] = {{48'000, 32'000},
                                 {44'100, 32'000},
                                 {96'000, 32'000},
                                 {32'000, 16'000},
                                 {22'050, 32'000},
                                 {16'000, 32'000}};
    for (const auto& [from, to] : kRates) {
        const auto level = [from = from, to = to](double share, int channels) {
            const double band = 0.5 * std::min(from, to);
            return level_after(SampleRate(from), SampleRate(to), share * band, channels);
        };
        for (const double share : {0.01, 0.3, 0.6, 0.7, 0.8, 0.84}) {
            EXPECT_NEAR(level(share, 1), 0.0, 0.1) << from << " to " << to << " at " << share;
        }
        for (const double share : {0.1, 0.5, 0.8, 0.84, 0.87, 0.9}) {
            EXPECT_NEAR(level(share, 1), level(share, 2), 0.02)
                << from << " to " << to << " at " << share;
        }
        for (const double share : {1.01, 1.1, 1.2, 1.3}) {
            if (share * std::min(from, to) < from) {
                EXPECT_LT(level(share, 1), -95.0) << from << " to " << to << " at " << share;
            }
        }
    }
}

TEST(Resampler, after_a_reset_it_gives_the_same_bits_again) {
    const std::vector<float> input = sine(SampleRate(44'100), 1234.5, 0.1);
    Resampler resampler;
    ASSERT_TRUE(resampler.prepare(SampleRate(44'100), kTo));
    std::vector<float> first(4'000);
    std::vector<float> second(4'000);
    const std::size_t made = resampler.process(input, first).made;
    resampler.reset();
    EXPECT_EQ(resampler.process(input, second).made, made);
    EXPECT_EQ(first, second);
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
