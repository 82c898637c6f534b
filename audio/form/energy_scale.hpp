#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "audio/form/hop_sound.hpp"

namespace raks::audio {

/// What makes the energy of music.
inline constexpr std::size_t kEnergyParts = 4;

/// Its parts at a moment: level, level of the low band, and brightness in dB; density of onsets as
/// a natural logarithm.
using EnergyParts = std::array<float, kEnergyParts>;

/// The parts of one hop. `floor`: dBFS below which levels are not followed, as a pause between two
/// notes has none. Density is not a logarithm yet, so that it can be averaged: log_density() of the
/// mean.
[[nodiscard]] inline EnergyParts energy_parts(const HopSound& sound, float floor) noexcept {
    // Magnitudes of the mel bands lie about 45 dB over the level of the samples.
    constexpr float kMelGain = 45.0F;
    const float level = std::max(sound.level, floor);
    return {level,
            std::max(sound.bands[0] - kMelGain, floor),
            std::clamp(sound.brightness(), -40.0F, 10.0F),
            sound.total_novelty()};
}
/// The last part as it is compared.
[[nodiscard]] inline float log_density(float novelty) noexcept { return std::log(novelty + 0.02F); }

/// Low, usual and high of one part in a song.
struct EnergyRange {
    float low = 0.0F;    ///< 5 % lie below
    float usual = 0.0F;  ///< the median
    float high = 0.0F;   ///< 5 % lie above
};

/// How the parts make the energy: [0, 1], 0.5 where all are as usual. The loudness counts most: it
/// is what a listener follows. `known`: [0, 1], how well the ranges are known; spans are wider
/// where they are not.
[[nodiscard]] inline float energy_of(const EnergyParts& parts,
                                     const std::array<EnergyRange, kEnergyParts>& ranges,
                                     float known) noexcept {
    constexpr std::array<float, kEnergyParts> kWeights = {0.76F, 0.08F, 0.08F, 0.08F};
    // Least distance of low and high from the usual: steady music stays near 0.5.
    constexpr std::array<float, kEnergyParts> kLeast = {3.0F, 5.0F, 5.0F, 0.4F};
    float energy = 0.0F;
    for (std::size_t i = 0; i < kEnergyParts; ++i) {
        const float least = kLeast[i] * (3.0F - 2.0F * known);
        const float apart = parts[i] - ranges[i].usual;
        const float span =
            apart < 0.0F ? ranges[i].usual - ranges[i].low : ranges[i].high - ranges[i].usual;
        energy += kWeights[i] * std::clamp(apart / std::max(span, least), -1.3F, 1.3F);
    }
    return std::clamp(0.5F + 0.5F * energy, 0.0F, 1.0F);
}

}  // namespace raks::audio
