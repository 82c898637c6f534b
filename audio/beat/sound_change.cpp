#include "audio/beat/sound_change.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

constexpr int kRemembered = 500;  // hops: mean and variance are of about as many
constexpr int kFewest = 200;      // hops of which they must be, to be compared with
// Means of the bands' squared distances over their variances. Where players only pause or come in
// all bands fall or rise, and what was counted still holds: in another song some do each.
constexpr double kChanged = 3.0;
constexpr double kEachWay = 0.5;
constexpr double kVariance = 0.02;  // added to each: steady tones have none

}  // namespace

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

/// Means of a window ago: those that a change has not touched yet.
void SoundChange::learn() noexcept {
    learnt_ = std::min(learnt_ + 1, kRemembered);
    const double share = 1.0 / learnt_;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double off = before_[band] / kWindow - mean_[band];
        mean_[band] += share * off;
        variance_[band] += share * ((1.0 - share) * off * off - variance_[band]);
    }
}

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
