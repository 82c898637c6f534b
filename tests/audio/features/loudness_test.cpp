#include "audio/features/loudness.hpp"

#include <gtest/gtest.h>

#include <ebur128.h>
#include <cmath>
#include <string>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

constexpr SampleRate kMeterRate(32'000);
constexpr std::size_t kHop = 320;

std::vector<float> tone(double hertz, double amplitude, double seconds) {
    std::vector<float> samples(static_cast<std::size_t>(kMeterRate.hertz() * seconds));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<float>(
            amplitude * std::sin(2.0 * M_PI * hertz * static_cast<double>(i) / kMeterRate.hertz()));
    }
    return samples;
}

std::vector<float> noise(double amplitude, double seconds, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> samples(static_cast<std::size_t>(kMeterRate.hertz() * seconds));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] = static_cast<float>(amplitude * (2.0 * random.uniform(i) - 1.0));
    }
    return samples;
}

// Momentary loudness of each hop, by both; libebur128's -inf counts as -120.
void compare_with_libebur128(const std::vector<float>& samples, const std::string& name) {
    LoudnessMeter meter(kMeterRate);
    ebur128_state* reference =
        ebur128_init(1, static_cast<unsigned long>(kMeterRate.hertz()), EBUR128_MODE_M);
    ASSERT_NE(reference, nullptr);
    for (std::size_t at = 0; at + kHop <= samples.size(); at += kHop) {
        meter.add(std::span(samples).subspan(at, kHop));
        ebur128_add_frames_float(reference, samples.data() + at, kHop);
        double expected = 0.0;
        ebur128_loudness_momentary(reference, &expected);
        ASSERT_NEAR(meter.momentary(), std::max(-120.0, expected), 1e-3)
            << name << ", sample " << at;
    }
    ebur128_destroy(&reference);
}

TEST(Loudness, is_that_of_libebur128) {
    for (const double hertz : {20.0, 60.0, 250.0, 997.0, 3'000.0, 9'000.0, 15'500.0}) {
        compare_with_libebur128(tone(hertz, 0.5, 1.5), std::to_string(hertz) + " Hz");
    }
    compare_with_libebur128(noise(0.1, 2.0, 1), "noise");
    compare_with_libebur128(noise(1e-4, 2.0, 1), "quiet noise");
    compare_with_libebur128(std::vector<float>(kMeterRate.hertz(), 0.0F), "silence");
    MusicPlan plan;
    plan.seconds = 5.0;
    plan.rate = kMeterRate;
    const auto song = generate(plan);
    ASSERT_TRUE(song);
    compare_with_libebur128(song->mono(), "music");
}

// EBU Tech 3341: a stereo sine at -23 dBFS has -23 LUFS; one channel alone is 3.01 dB lower.
TEST(Loudness, a_sine_has_its_level) {
    LoudnessMeter meter(kMeterRate);
    meter.add(tone(1'000.0, std::pow(10.0, -23.0 / 20.0), 1.0));
    EXPECT_NEAR(meter.momentary(), -26.01, 0.05);
}

TEST(Loudness, is_minus_120_before_sound_and_after_a_reset) {
    LoudnessMeter meter(kMeterRate);
    EXPECT_EQ(meter.momentary(), -120.0F);
    const std::vector<float> loud = noise(1.0, 1.0, 2);
    raks::test::RealtimeScope scope;
    meter.add(loud);
    const float before = meter.momentary();
    meter.reset();
    const float after = meter.momentary();
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_GT(before, -20.0F);
    EXPECT_EQ(after, -120.0F);
}

// What was loud is gone after 400 ms and leaves nothing behind: no sum is carried on.
TEST(Loudness, does_not_drift) {
    LoudnessMeter old(kMeterRate);
    LoudnessMeter young(kMeterRate);
    for (std::uint64_t second = 0; second < 120; ++second) {
        old.add(noise(16.0, 1.0, second));
    }
    const std::vector<float> quiet = noise(1e-4, 3.0, 999);
    old.add(quiet);
    young.add(quiet);
    EXPECT_NEAR(old.momentary(), young.momentary(), 1e-5);
}

TEST(Loudness, any_blocks_give_the_same_bits) {
    const std::vector<float> samples = noise(0.3, 1.0, 3);
    LoudnessMeter whole(kMeterRate);
    LoudnessMeter parts(kMeterRate);
    whole.add(samples);
    for (std::size_t at = 0; at < samples.size();) {
        const std::size_t count = std::min<std::size_t>(1 + at % 97, samples.size() - at);
        parts.add(std::span(samples).subspan(at, count));
        at += count;
    }
    EXPECT_EQ(whole.momentary(), parts.momentary());
}

}  // namespace
}  // namespace raks::audio
