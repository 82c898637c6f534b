#include "training/networks/mel_augmentation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raks::audio {
namespace {

constexpr std::size_t kBands = NetworkInput::kBands;

}  // namespace

MelAugmentation MelAugmentation::plain() {
    MelAugmentation augmentation;
    augmentation.gain.fill(1.0F);
    return augmentation;
}

MelAugmentation MelAugmentation::draw(std::size_t piece_hops,
                                      std::size_t hops,
                                      double most_stretch,
                                      Dice& dice) {
    MelAugmentation augmentation;
    // Three in ten keep their tempo.
    augmentation.stretch =
        dice.chance(0.7) ? std::exp(dice.uniform(-most_stretch, most_stretch)) : 1.0;
    const double span = static_cast<double>(hops) * augmentation.stretch;
    // Hops of the piece that remain before the stretch would run past its end.
    const double room = static_cast<double>(piece_hops) - span;
    augmentation.first_hop = dice.uniform(0.0, std::max(0.0, room));
    // A smooth gain curve over the bands: four cosines with a standard deviation of 0.45 together,
    // on an overall gain, all in natural logarithms of magnitude.
    std::array<double, 4> waves{};
    for (double& wave : waves) {
        wave = dice.normal(0.32);
    }
    const double overall = dice.normal(0.5);
    for (std::size_t band = 0; band < kBands; ++band) {
        double log_gain = overall;
        for (std::size_t wave = 0; wave < waves.size(); ++wave) {
            const double angle = std::numbers::pi * static_cast<double>((wave + 1) * band) / kBands;
            log_gain += waves[wave] * std::cos(angle);
        }
        augmentation.gain[band] = static_cast<float>(std::exp(log_gain));
    }
    // A range of bands damped, as by a small loudspeaker.
    if (dice.chance(0.3)) {
        const auto first = static_cast<std::size_t>(dice.whole(0, kBands - 1));
        const auto end = std::min(kBands, first + static_cast<std::size_t>(dice.whole(3, 14)));
        const auto damping = static_cast<float>(dice.uniform(0.02, 0.5));
        for (std::size_t band = first; band < end; ++band) {
            augmentation.gain[band] *= damping;
        }
    }
    // Single bands dropped.
    for (float& gain : augmentation.gain) {
        gain = dice.chance(0.03) ? 0.0F : gain;
    }
    // Relative to the mean magnitude, in augment_bands.
    augmentation.noise = dice.chance(0.3) ? static_cast<float>(dice.log_uniform(0.01, 0.4)) : 0.0F;
    return augmentation;
}

void MelAugmentation::enter_room(Dice& dice) {
    constexpr double kHopSeconds = 0.01;
    const double seconds = dice.log_uniform(0.15, 1.0);  // to -60 dB
    // -60 dB is a factor of 1e-6 in energy, spread over the hops of the reverberation time.
    decay = static_cast<float>(std::pow(10.0, -6.0 * kHopSeconds / seconds));
    reverberation = static_cast<float>(dice.log_uniform(0.05, 5.0));
}

void MelAugmentation::muffle(Dice& dice) {
    // Each band from `first` on is damped by exp(-slope) more than the one below.
    const auto first = static_cast<std::size_t>(dice.whole(14, 34));
    const double slope = dice.uniform(0.2, 2.0);
    for (std::size_t band = first; band < kBands; ++band) {
        gain[band] *= static_cast<float>(std::exp(-slope * static_cast<double>(band - first + 1)));
    }
}

void RoomEcho::add(const MelAugmentation& augmentation, Bands& bands) {
    for (std::size_t band = 0; band < kBands; ++band) {
        // Energies add, magnitudes do not. The weights decay and 1 - decay make the echo of a
        // steady sound as strong as the sound, times `reverberation`.
        const float direct = bands[band] * bands[band];
        energy_[band] = augmentation.decay * energy_[band] + (1.0F - augmentation.decay) * direct;
        bands[band] = std::sqrt(direct + augmentation.reverberation * energy_[band]);
    }
}

std::array<float, kBands> magnitudes_at(std::span<const float> mel, double hop) {
    // Linear interpolation between the two hops around `hop`.
    const std::size_t hops = mel.size() / kBands;
    const double clamped = std::clamp(hop, 0.0, static_cast<double>(hops) - 1.0);
    const auto low = static_cast<std::size_t>(clamped);
    const std::size_t high = std::min(low + 1, hops - 1);
    const auto share = static_cast<float>(clamped - static_cast<double>(low));
    std::array<float, kBands> bands{};
    for (std::size_t band = 0; band < kBands; ++band) {
        const float before = mel[low * kBands + band];
        bands[band] = before + share * (mel[high * kBands + band] - before);
    }
    return bands;
}

float mean_magnitude(std::span<const float> mel) {
    double sum = 0.0;
    for (const float value : mel) {
        sum += static_cast<double>(value);
    }
    return static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, mel.size())));
}

}  // namespace raks::audio
