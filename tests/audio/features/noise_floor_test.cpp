#include "audio/features/noise_floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

using Bands = NoiseFloor::Bands;

/// Mel magnitudes of every whole window of `samples` at 32 kHz.
std::vector<Bands> magnitudes_of(const std::vector<float>& samples) {
    OnsetDetector detector;
    std::vector<Bands> magnitudes;
    for (std::size_t at = 0; at + OnsetDetector::kWindow <= samples.size();
         at += OnsetDetector::kHop) {
        detector.compute(std::span(samples).subspan(at, OnsetDetector::kWindow), false);
        std::ranges::copy(detector.mel_magnitudes(), magnitudes.emplace_back().begin());
    }
    return magnitudes;
}

std::vector<float> with_noise(std::vector<float> samples, float peak) {
    const CounterRandom random(5);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i] += static_cast<float>(2.0 * random.uniform(i) - 1.0) * peak;
    }
    return samples;
}

std::vector<float> twelve_seconds_of(Style style) {
    MusicPlan plan;
    plan.style = style;
    plan.tempo = {{0.0, 120.0}};
    plan.seconds = 12.0;
    plan.rate = SampleRate(OnsetDetector::kSampleRate);
    plan.channels = 1;
    return generate(plan)->samples;
}

std::vector<float> silence(double seconds) {
    return std::vector<float>(static_cast<std::size_t>(seconds * OnsetDetector::kSampleRate));
}

/// What `floor` leaves of each hop.
std::vector<Bands> subtract(const std::vector<Bands>& hops, NoiseFloor& floor) {
    std::vector<Bands> quiet;
    quiet.reserve(hops.size());
    for (const Bands& hop : hops) {
        quiet.push_back(floor.subtract(hop));
    }
    return quiet;
}

/// Sum of all bands over the hops from `first` on.
double sum_of(const std::vector<Bands>& hops, std::size_t first) {
    double sum = 0.0;
    for (std::size_t i = first; i < hops.size(); ++i) {
        sum += std::accumulate(hops[i].begin(), hops[i].end(), 0.0);
    }
    return sum;
}

double distance(const std::vector<Bands>& a, const std::vector<Bands>& b, std::size_t first) {
    double sum = 0.0;
    for (std::size_t i = first; i < std::min(a.size(), b.size()); ++i) {
        for (std::size_t band = 0; band < a[i].size(); ++band) {
            sum += std::abs(static_cast<double>(a[i][band] - b[i][band]));
        }
    }
    return sum;
}

constexpr std::size_t kHeard = 100;  // hops, after which the floor is known

TEST(NoiseFloor, finds_the_level_of_white_noise_at_any_gain) {
    const std::vector<Bands> noise = magnitudes_of(with_noise(silence(8.0), 0.1F));
    const Bands white = OnsetDetector::white_magnitudes();
    const double mean = sum_of(noise, 0) / static_cast<double>(noise.size()) /
                        std::accumulate(white.begin(), white.end(), 0.0);
    NoiseFloor floor;
    subtract(noise, floor);
    EXPECT_LT(floor.level(), mean);
    EXPECT_GT(floor.level(), 0.6 * mean);

    NoiseFloor quieter;
    subtract(magnitudes_of(with_noise(silence(8.0), 0.025F)), quieter);
    EXPECT_NEAR(quieter.level(), 0.25F * floor.level(), 1e-4F * floor.level());
}

TEST(NoiseFloor, brings_noisy_music_nearer_to_the_clean) {
    for (const Style style : {Style::montuno, Style::maqsum, Style::four_on_the_floor}) {
        const std::vector<float> clean = twelve_seconds_of(style);
        const double power = std::inner_product(clean.begin(), clean.end(), clean.begin(), 0.0) /
                             static_cast<double>(clean.size());
        const auto peak = static_cast<float>(std::sqrt(3.0 * power / 10.0));  // 10 dB below
        const std::vector<Bands> wanted = magnitudes_of(clean);
        const std::vector<Bands> noisy = magnitudes_of(with_noise(clean, peak));
        NoiseFloor floor;
        EXPECT_LT(distance(subtract(noisy, floor), wanted, kHeard),
                  0.6 * distance(noisy, wanted, kHeard));
    }
}

TEST(NoiseFloor, leaves_music_without_noise_as_it_is) {
    for (const Style style : {Style::montuno, Style::maqsum, Style::four_on_the_floor}) {
        const std::vector<Bands> clean = magnitudes_of(twelve_seconds_of(style));
        NoiseFloor floor;
        EXPECT_LT(distance(subtract(clean, floor), clean, 0), 0.01 * sum_of(clean, 0));
    }
}

TEST(NoiseFloor, leaves_sound_that_is_not_alike_in_all_bands) {
    std::vector<float> samples = with_noise(silence(6.0), 0.1F);
    float low = 0.0F;
    for (float& sample : samples) {
        low += 0.1F * (sample - low);  // falls by 6 dB an octave above 500 Hz
        sample = low;
    }
    const std::vector<Bands> hops = magnitudes_of(samples);
    NoiseFloor floor;
    EXPECT_EQ(subtract(hops, floor), hops);
}

TEST(NoiseFloor, forgets_noise_that_stops_and_learns_noise_that_comes) {
    std::vector<float> samples = with_noise(silence(4.0), 0.1F);
    const std::vector<float> softer = with_noise(silence(4.0), 0.01F);
    samples.insert(samples.end(), softer.begin(), softer.end());
    const std::vector<Bands> hops = magnitudes_of(samples);
    NoiseFloor floor;
    float loud = 0.0F;
    for (std::size_t hop = 0; hop < hops.size(); ++hop) {
        static_cast<void>(floor.subtract(hops[hop]));
        loud = hop == 390 ? floor.level() : loud;
    }
    EXPECT_NEAR(floor.level(), 0.1F * loud, 0.02F * loud);
    const std::vector<Bands> again = magnitudes_of(with_noise(silence(6.0), 0.1F));
    subtract(again, floor);
    EXPECT_NEAR(floor.level(), loud, 0.1F * loud);
}

TEST(NoiseFloor, is_bounded_and_begins_anew) {
    const std::vector<Bands> noise = magnitudes_of(with_noise(silence(3.0), 1.0F));
    NoiseFloor floor;
    const std::vector<Bands> first = subtract(noise, floor);
    for (std::size_t hop = 0; hop < noise.size(); ++hop) {
        for (std::size_t band = 0; band < noise[hop].size(); ++band) {
            EXPECT_GE(first[hop][band], 0.0F);
            EXPECT_LE(first[hop][band], noise[hop][band]);
        }
    }
    bool is_same = true;
    test::RealtimeScope scope;
    floor.reset();
    for (std::size_t hop = 0; hop < noise.size(); ++hop) {
        is_same = is_same && floor.subtract(noise[hop]) == first[hop];
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_TRUE(is_same);
}

}  // namespace
}  // namespace raks::audio
