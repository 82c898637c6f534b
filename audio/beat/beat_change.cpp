#include "audio/beat/beat_change.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr float kLevelShare = 0.1F;        // of a beat in the running level of each band
constexpr float kStatisticsShare = 0.06F;  // of a beat in mean and variance of the change
constexpr float kCompression = 4.0F;       // log(1 + 4 x magnitude / level)
constexpr float kFloor = 1e-9F;            // digital silence has no level
constexpr int kFirstBeats = 4;             // beats before the statistics are used
constexpr float kMost = 3.0F;              // standard deviations

}  // namespace

void BeatChange::reset() noexcept RAKS_NONBLOCKING {
    sum_ = level_ = before_ = {};
    hops_ = beats_ = 0;
    mean_ = variance_ = 0.0F;
}

// Sums; the mean is taken when the beat ends and its length is known.
void BeatChange::add(std::span<const float, OnsetDetector::kMelBands> magnitudes) noexcept
    RAKS_NONBLOCKING {
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        sum_[i] += magnitudes[i];
    }
    ++hops_;
}

// Distance of the two beats' spectra: mean absolute difference over the bands.
float BeatChange::next_beat() noexcept RAKS_NONBLOCKING {
    if (hops_ == 0) {
        return 0.0F;
    }
    float change = 0.0F;
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const float mean = sum_[i] / static_cast<float>(hops_);
        level_[i] += (beats_ == 0 ? 1.0F : kLevelShare) * (mean - level_[i]);
        const float now = std::log1p(kCompression * mean / (level_[i] + kFloor));
        change += std::abs(now - before_[i]) / static_cast<float>(sum_.size());
        before_[i] = now;
    }
    sum_ = {};
    hops_ = 0;
    ++beats_;
    if (beats_ == 1) {
        return 0.0F;
    }
    // Plain mean and variance at first, exponential ones later (Welford's update).
    const float share = std::max(kStatisticsShare, 1.0F / static_cast<float>(beats_ - 1));
    // Against the statistics before this beat: it must not excuse itself.
    const float apart = change - mean_;
    const float deviation = std::sqrt(variance_) + kFloor;
    mean_ += share * apart;
    variance_ += share * (apart * (change - mean_) - variance_);
    return beats_ < kFirstBeats ? 0.0F : std::clamp(apart / deviation, -kMost, kMost);
}

}  // namespace raks::audio
