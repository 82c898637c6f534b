#include "audio/form/energy_meter.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

// Each of two low-passes takes this share of the difference a hop, which is 0.13 s: half of what
// they give is of the last quarter of a second, nearly all of the last half.
constexpr float kSmoothingShare = 1.0F / 13.0F;
// Hops between two values that are added to a range.
constexpr int kRangeHops = 20;
// Hops between two energies that are kept, and how many of these "lately" means: 4 s.
constexpr int kKeptHops = 10;
constexpr std::size_t kLatelyEnergies = 40;
// The gate closes by this share a hop when music stops, and opens likewise: in 0.15 s.
constexpr float kGateShare = 1.0F / 15.0F;
// Levels are not followed where they are so many dB under the high level.
constexpr float kFloorDecibels = 45.0F;
// After so many hops the range of a song is known.
constexpr float kKnownHops = 1500.0F;

}  // namespace

// Levels are averaged as dB, as a listener's sense of loudness is: a mean of powers would be that
// of the loudest drum, and sparse music as loud as dense.
void EnergyMeter::follow(const HopSound& sound) noexcept {
    const float floor = ranges_[0].size() == 0 ? sound.level : known_[0].high - kFloorDecibels;
    const EnergyParts parts = energy_parts(sound, floor);
    if (!has_begun_) {
        has_begun_ = true;
        first_ = second_ = parts;
    }
    for (std::size_t i = 0; i < kEnergyParts; ++i) {
        first_[i] += kSmoothingShare * (parts[i] - first_[i]);
        second_[i] += kSmoothingShare * (first_[i] - second_[i]);
    }
}

// Energy of the smoothed parts; now and then they are added to their ranges.
float EnergyMeter::measure() noexcept {
    EnergyParts parts = second_;
    parts[3] = log_density(parts[3]);
    if (hops_ % kRangeHops == 0) {
        for (std::size_t i = 0; i < kEnergyParts; ++i) {
            ranges_[i].add(parts[i]);
            known_[i] = {ranges_[i].at(0.05), ranges_[i].at(0.5), ranges_[i].at(0.95)};
        }
    }
    ++hops_;
    return energy_of(parts, known_, std::min(1.0F, static_cast<float>(hops_) / kKnownHops));
}

// Means of the last 4 and 30 s.
void EnergyMeter::average(float now) noexcept {
    sum_ += now;
    if (++summed_ < kKeptHops) {
        return;
    }
    kept_[kept_count_ % kKept] = sum_ / static_cast<float>(summed_);
    ++kept_count_;
    sum_ = 0.0F;
    summed_ = 0;
    const auto mean = [this](std::size_t most) {
        const std::size_t count = std::min({kept_count_, kKept, most});
        float sum = 0.0F;
        for (std::size_t i = 1; i <= count; ++i) {
            sum += kept_[(kept_count_ - i) % kKept];
        }
        return sum / static_cast<float>(count);
    };
    energy_.lately = mean(kLatelyEnergies);
    energy_.longer = mean(kKept);
}

MusicEnergy EnergyMeter::advance(const HopSound& sound, bool is_stopped) noexcept RAKS_NONBLOCKING {
    gate_ = std::clamp(gate_ + (is_stopped ? -kGateShare : kGateShare), 0.0F, 1.0F);
    if (is_stopped) {
        energy_.now = gate_ * energy_.now;
        // Music that comes back starts from its own level.
        has_begun_ = false;
    } else {
        follow(sound);
        energy_.now = gate_ * measure();
    }
    // Before any music there is nothing to average: the values stay as usual.
    if (hops_ > 0) {
        average(energy_.now);
    }
    return energy_;
}

}  // namespace raks::audio
