#include "audio/form/spectrum_meter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "audio/features/onset.hpp"

namespace raks::audio {
namespace {

/// Mel magnitudes of a tone, full scale at gain 1, as the analyzer has them.
std::array<float, SpectrumMeter::kMelBands> mel_of_tone(double hertz, float gain) {
    OnsetDetector detector;
    std::vector<float> window(OnsetDetector::kWindow);
    for (std::size_t i = 0; i < window.size(); ++i) {
        const double angle =
            2.0 * std::numbers::pi * hertz * static_cast<double>(i) / OnsetDetector::kSampleRate;
        window[i] = gain * static_cast<float>(std::sin(angle));
    }
    detector.compute(window, false);
    std::array<float, SpectrumMeter::kMelBands> mel{};
    std::copy(detector.mel_magnitudes().begin(), detector.mel_magnitudes().end(), mel.begin());
    return mel;
}

std::size_t strongest(const MusicSpectrum& spectrum) {
    return static_cast<std::size_t>(std::max_element(spectrum.bands.begin(), spectrum.bands.end()) -
                                    spectrum.bands.begin());
}

TEST(SpectrumMeter, a_tone_fills_its_band_and_says_its_frequency) {
    std::size_t before = 0;
    for (const double hertz : {60.0, 250.0, 700.0, 2'000.0, 5'000.0, 11'000.0}) {
        SpectrumMeter meter;
        const MusicSpectrum spectrum = meter.advance(-10.0F, mel_of_tone(hertz, 0.5F));
        EXPECT_EQ(spectrum.bands[strongest(spectrum)], 255) << hertz;
        EXPECT_GE(strongest(spectrum), before) << hertz;
        before = strongest(spectrum) + 1;
        // The mel bands are about 90 Hz wide at the low end, a sixth of an octave at the high one.
        EXPECT_NEAR(spectrum.strongest_hz, hertz, 50.0 + 0.08 * hertz) << hertz;
    }
}

TEST(SpectrumMeter, soft_music_fills_the_bands_as_loud_music_does) {
    SpectrumMeter loud;
    SpectrumMeter soft;
    const MusicSpectrum spectrum = loud.advance(-6.0F, mel_of_tone(440.0, 0.5F));
    EXPECT_EQ(spectrum, soft.advance(-46.0F, mel_of_tone(440.0, 0.005F)));
}

TEST(SpectrumMeter, what_is_softer_than_of_late_is_lower_and_36_dB_below_it_0) {
    SpectrumMeter meter;
    const MusicSpectrum full = meter.advance(-6.0F, mel_of_tone(440.0, 0.5F));
    const std::size_t band = strongest(full);
    const MusicSpectrum half = meter.advance(-24.0F, mel_of_tone(440.0, 0.5F * 0.1259F));
    EXPECT_NEAR(half.bands[band], 128, 1) << "18 of 36 dB";
    EXPECT_EQ(meter.advance(-45.0F, mel_of_tone(440.0, 0.005F)).bands[band], 0);
}

TEST(SpectrumMeter, silence_is_dark) {
    SpectrumMeter meter;
    static_cast<void>(meter.advance(-6.0F, mel_of_tone(440.0, 0.5F)));
    constexpr std::array<float, SpectrumMeter::kMelBands> kNothing{};
    EXPECT_EQ(meter.advance(-120.0F, kNothing), MusicSpectrum());
}

}  // namespace
}  // namespace raks::audio
