#include "audio/features/spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "audio/features/real_fft.hpp"
#include "base/random.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

std::vector<float> noise_of(std::size_t count, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        samples[i] = static_cast<float>(random.normal(i));
    }
    return samples;
}

// |X|^2 by the definition, in double precision.
std::vector<double> power_by_definition(const std::vector<float>& samples) {
    const std::size_t size = samples.size();
    std::vector<double> power(size / 2 + 1);
    for (std::size_t k = 0; k < power.size(); ++k) {
        std::complex<double> sum = 0.0;
        for (std::size_t i = 0; i < size; ++i) {
            const auto turns = static_cast<double>(i * k % size) / static_cast<double>(size);
            sum += static_cast<double>(samples[i]) * std::polar(1.0, -2.0 * M_PI * turns);
        }
        power[k] = std::norm(sum);
    }
    return power;
}

// Every number of passes, with and without one of radix 2.
TEST(RealFft, is_the_transform_by_its_definition) {
    for (std::size_t size = 128; size <= 4096; size *= 2) {
        const std::vector<float> samples = noise_of(size, size);
        const std::vector<double> expected = power_by_definition(samples);
        std::vector<float> power(size / 2 + 1);
        RealFft(size).power_spectrum(samples, power);
        const double greatest = *std::max_element(expected.begin(), expected.end());
        for (std::size_t k = 0; k < power.size(); ++k) {
            ASSERT_NEAR(power[k], expected[k], 1e-6 * greatest) << size << ", bin " << k;
            // Bins that are small against the others keep their digits, too.
            ASSERT_NEAR(std::sqrt(power[k]),
                        std::sqrt(expected[k]),
                        1e-5 * std::sqrt(expected[k]) + 1e-6 * std::sqrt(greatest))
                << size << ", bin " << k;
        }
    }
}

TEST(RealFft, a_sample_alone_is_white_and_a_constant_is_in_bin_0) {
    RealFft transform(512);
    std::vector<float> samples(512);
    std::vector<float> power(257);
    samples[77] = 2.0F;
    transform.power_spectrum(samples, power);
    for (const float bin : power) {
        ASSERT_NEAR(bin, 4.0F, 1e-5);
    }
    std::fill(samples.begin(), samples.end(), 1.0F);
    transform.power_spectrum(samples, power);
    EXPECT_EQ(power[0], 512.0F * 512.0F);
    for (std::size_t k = 1; k < power.size(); ++k) {
        ASSERT_NEAR(power[k], 0.0F, 1e-6);
    }
}

TEST(RealFft, what_it_transformed_before_leaves_nothing) {
    const std::vector<float> samples = noise_of(1024, 3);
    RealFft fresh(1024);
    RealFft used(1024);
    std::vector<float> expected(513);
    std::vector<float> power(513);
    fresh.power_spectrum(samples, expected);
    raks::test::RealtimeScope scope;
    used.power_spectrum(samples, power);
    used.power_spectrum(samples, power);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    EXPECT_EQ(power, expected);
}

TEST(PowerSpectrum, weighs_the_samples_and_fills_up_with_zeros) {
    const std::vector<float> samples = noise_of(400, 5);
    const std::vector<float> window = hamming_window(400);
    std::vector<float> padded(512);
    std::transform(samples.begin(),
                   samples.end(),
                   window.begin(),
                   padded.begin(),
                   [](float sample, float weight) { return sample * weight; });
    std::vector<float> expected(257);
    RealFft(512).power_spectrum(padded, expected);
    PowerSpectrum spectrum(window, 512);
    const auto power = spectrum.compute(samples);
    EXPECT_TRUE(std::equal(power.begin(), power.end(), expected.begin(), expected.end()));
    const auto magnitudes = spectrum.compute_magnitudes(samples);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_EQ(magnitudes[k], std::sqrt(expected[k])) << k;
    }
}

// Filters of all lengths around a register's.
TEST(FilterBank, sums_its_bins_by_their_weights) {
    const std::vector<float> spectrum = noise_of(200, 7);
    std::vector<FilterBank::Filter> filters;
    for (std::size_t length = 0; length < 40; ++length) {
        filters.push_back({static_cast<int>(3 * length), noise_of(length, length)});
    }
    std::vector<float> bands(filters.size());
    FilterBank(filters).apply(spectrum, bands);
    for (std::size_t length = 0; length < 40; ++length) {
        double expected = 0.0;
        for (std::size_t i = 0; i < length; ++i) {
            expected += static_cast<double>(spectrum[3 * length + i]) *
                        static_cast<double>(filters[length].weights[i]);
        }
        EXPECT_NEAR(bands[length], expected, 1e-5) << length;
    }
}

}  // namespace
}  // namespace raks::audio
