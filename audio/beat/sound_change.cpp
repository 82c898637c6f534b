#include "audio/beat/sound_change.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

constexpr int kRemembered = 500;  // hops: memory of mean and variance
constexpr int kFewest = 200;      // hops that they must contain before a comparison
// Thresholds of the bands' squared distances over their variances, averaged: of all, and of those
// that became louder and of those that became softer. Where players pause or come in, all bands
// fall or rise, and the beats go on; in another song some bands do each.
constexpr double kChanged = 3.0;
constexpr double kEachWay = 0.5;
constexpr double kVariance = 0.02;  // added to each variance: steady tones have none

}  // namespace

// Running sums over the last window and the one before it: each hop enters one and leaves the
// other.
void SoundChange::slide(std::span<const float, kBands> loudness) noexcept {
    const auto& middle = ring_[(next_ + kWindow) % kKept];
    auto& oldest = ring_[next_];
    for (std::size_t band = 0; band < kBands; ++band) {
        const auto leaves = static_cast<double>(middle[band]);
        newest_[band] += static_cast<double>(loudness[band]) - leaves;
        before_[band] += leaves - static_cast<double>(oldest[band]);
        oldest[band] = loudness[band];
    }
    next_ = (next_ + 1) % kKept;
    hops_ = std::min(hops_ + 1, static_cast<int>(kKept));
}

// Learns from the window before the last: the last one may already be of another song.
void SoundChange::learn() noexcept {
    learnt_ = std::min(learnt_ + 1, kRemembered);
    const double share = 1.0 / learnt_;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double off = before_[band] / kWindow - mean_[band];
        mean_[band] += share * off;
        variance_[band] += share * ((1.0 - share) * off * off - variance_[band]);
    }
}

// Distance of the last window from what was learnt, apart for bands that rose and fell.
bool SoundChange::is_another() const noexcept {
    double louder = 0.0;
    double softer = 0.0;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double off = newest_[band] / kWindow - mean_[band];
        const double distance = off * off / (variance_[band] + kVariance) / kBands;
        (off > 0.0 ? louder : softer) += distance;
    }
    return louder + softer > kChanged && std::min(louder, softer) > kEachWay;
}

// After a change the statistics start anew.
bool SoundChange::add(std::span<const float, kBands> loudness) noexcept RAKS_NONBLOCKING {
    slide(loudness);
    if (hops_ < static_cast<int>(kKept)) {
        return false;
    }
    const bool is_changed = learnt_ > kFewest && is_another();
    if (is_changed) {
        learnt_ = 0;
    }
    learn();
    return is_changed;
}

}  // namespace raks::audio
