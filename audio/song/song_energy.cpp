#include "audio/song/song_energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "audio/form/energy_scale.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr double kSigma = 20.0;        // hops, of the Gaussian of `now`: half a second wide
constexpr std::ptrdiff_t kReach = 50;  // hops to either side
constexpr float kEnergyFloor = 45.0F;  // dB below the high level where levels are not followed
constexpr std::size_t kLately = 200;   // hops to either side
constexpr std::size_t kLonger = 3000;  // hops before
constexpr float kGate = 15.0F;         // hops in which the energy falls to 0 in a pause

// By hop: whether something sounds.
std::vector<char> sounding(std::size_t hops, const std::vector<SongPause>& pauses) {
    std::vector<char> sounds(hops, 1);
    for (const SongPause& pause : pauses) {
        std::fill(sounds.begin() + static_cast<std::ptrdiff_t>(pause.first),
                  sounds.begin() + static_cast<std::ptrdiff_t>(pause.end),
                  0);
    }
    return sounds;
}

// Means around each hop that sounds, over those around it that do.
std::vector<EnergyParts> smoothed(const std::vector<EnergyParts>& parts,
                                  const std::vector<char>& sounds) {
    std::array<float, kReach + 1> weights{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double place = static_cast<double>(i) / kSigma;
        weights[i] = static_cast<float>(std::exp(-0.5 * place * place));
    }
    const auto hops = static_cast<std::ptrdiff_t>(parts.size());
    std::vector<EnergyParts> result(parts.size());
    for (std::ptrdiff_t hop = 0; hop < hops; ++hop) {
        EnergyParts sum{};
        float total = 0.0F;
        for (std::ptrdiff_t at = std::max<std::ptrdiff_t>(0, hop - kReach);
             at < std::min(hops, hop + kReach + 1);
             ++at) {
            if (sounds[static_cast<std::size_t>(at)] == 0) {
                continue;
            }
            const float weight = weights[static_cast<std::size_t>(std::abs(at - hop))];
            total += weight;
            for (std::size_t i = 0; i < kEnergyParts; ++i) {
                sum[i] += weight * parts[static_cast<std::size_t>(at)][i];
            }
        }
        for (float& part : sum) {
            part /= std::max(total, 1e-6F);
        }
        sum[3] = log_density(sum[3]);
        result[static_cast<std::size_t>(hop)] = sum;
    }
    return result;
}

// Of the hops that sound.
std::array<EnergyRange, kEnergyParts> ranges_of(const std::vector<EnergyParts>& parts,
                                                const std::vector<char>& sounds) {
    std::array<EnergyRange, kEnergyParts> ranges;
    for (std::size_t i = 0; i < kEnergyParts; ++i) {
        std::vector<double> values;
        for (std::size_t hop = 0; hop < parts.size(); ++hop) {
            if (sounds[hop] != 0) {
                values.push_back(static_cast<double>(parts[hop][i]));
            }
        }
        ranges[i] = {static_cast<float>(percentile(values, 0.05)),
                     static_cast<float>(percentile(values, 0.5)),
                     static_cast<float>(percentile(values, 0.95))};
    }
    return ranges;
}

// 1 while something sounds; in a pause it falls from the last sound on.
std::vector<float> gates(const std::vector<char>& sounds) {
    std::vector<float> gates(sounds.size());
    float gate = 0.0F;
    for (std::size_t hop = 0; hop < sounds.size(); ++hop) {
        gate = sounds[hop] != 0 ? 1.0F : std::max(0.0F, gate - 1.0F / kGate);
        gates[hop] = gate;
    }
    return gates;
}

}  // namespace

std::vector<MusicEnergy> measure_energy(std::span<const HopSound> sounds,
                                        const std::vector<SongPause>& pauses) {
    const std::vector<char> is_sounding = sounding(sounds.size(), pauses);
    std::vector<double> levels;
    for (std::size_t hop = 0; hop < sounds.size(); ++hop) {
        if (is_sounding[hop] != 0) {
            levels.push_back(static_cast<double>(sounds[hop].level));
        }
    }
    const float floor = static_cast<float>(percentile(levels, 0.95)) - kEnergyFloor;
    std::vector<EnergyParts> parts;
    parts.reserve(sounds.size());
    for (const HopSound& sound : sounds) {
        parts.push_back(energy_parts(sound, floor));
    }
    parts = smoothed(parts, is_sounding);
    const auto ranges = ranges_of(parts, is_sounding);
    const std::vector<float> gate = gates(is_sounding);
    std::vector<MusicEnergy> energies(sounds.size());
    std::vector<double> sums(sounds.size() + 1);
    float last = 0.0F;  // of the last hop that sounded
    for (std::size_t hop = 0; hop < sounds.size(); ++hop) {
        last = is_sounding[hop] != 0 ? energy_of(parts[hop], ranges, 1.0F) : last;
        energies[hop].now = gate[hop] * last;
        sums[hop + 1] = sums[hop] + static_cast<double>(energies[hop].now);
    }
    const auto mean = [&](std::size_t first, std::size_t end) {
        return static_cast<float>((sums[end] - sums[first]) / static_cast<double>(end - first));
    };
    for (std::size_t hop = 0; hop < sounds.size(); ++hop) {
        const std::size_t end = std::min(sounds.size(), hop + kLately + 1);
        energies[hop].lately = mean(hop - std::min(hop, kLately), end);
        energies[hop].longer = mean(hop - std::min(hop, kLonger), hop + 1);
    }
    return energies;
}

}  // namespace raks::audio
