#include "audio/form/spectrum_meter.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

// Mel bands (30 to 15,500 Hz in 36) at which the bands begin; the last one ends with them.
constexpr std::array<std::size_t, MusicSpectrum::kBands + 1> kFirstMel = {
    0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 18, 21, 24, 28, 32, SpectrumMeter::kMelBands};
// Centres of the mel bands are so far apart, in mel = 1127 ln(1 + f / 700).
constexpr float kLowestMel = 47.3F;   // of 30 Hz
constexpr float kMelStep = 94.42F;    // (mel of 15,500 Hz - kLowestMel) / 37
constexpr float kShownRange = 36.0F;  // dB that a band shows
// A band is held against its own loudest sound, but no band is drawn up by more than this.
constexpr float kMostApart = 18.0F;
// The loudest sound of late sinks by so many dB a hop: 6 dB in 6 s.
constexpr float kLoudestSink = 0.01F;
constexpr float kSilentSpectrum = -70.0F;  // dBFS
constexpr float kLeastBandPower = 1e-12F;

float hertz_of_mel_band(float band) {
    return 700.0F * (std::exp((kLowestMel + kMelStep * (band + 1.0F)) / 1127.0F) - 1.0F);
}

}  // namespace

MusicSpectrum SpectrumMeter::advance(
    float level_dbfs, std::span<const float, kMelBands> mel) noexcept RAKS_NONBLOCKING {
    MusicSpectrum spectrum;
    std::array<float, MusicSpectrum::kBands> decibels{};
    for (std::size_t band = 0; band < decibels.size(); ++band) {
        float power = kLeastBandPower;
        for (std::size_t i = kFirstMel[band]; i < kFirstMel[band + 1]; ++i) {
            power += mel[i] * mel[i];
        }
        decibels[band] = 10.0F * std::log10(power);
        loudest_[band] = std::max({decibels[band], loudest_[band] - kLoudestSink, kFloor});
    }
    if (level_dbfs < kSilentSpectrum) {
        return spectrum;
    }
    const float top = *std::max_element(loudest_.begin(), loudest_.end());
    for (std::size_t band = 0; band < decibels.size(); ++band) {
        const float full = std::max(loudest_[band], top - kMostApart);
        const float share = std::clamp(1.0F - (full - decibels[band]) / kShownRange, 0.0F, 1.0F);
        spectrum.bands[band] = static_cast<std::uint8_t>(std::lround(255.0F * share));
    }
    const auto strongest = std::max_element(mel.begin(), mel.end()) - mel.begin();
    spectrum.strongest_hz = hertz_of_mel_band(static_cast<float>(strongest));
    return spectrum;
}

}  // namespace raks::audio
