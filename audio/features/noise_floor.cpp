#include "audio/features/noise_floor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

namespace raks::audio {
namespace {

constexpr float kSmoothing = 0.1F;        // share of the newest hop
constexpr std::int64_t kSettled = 30;     // hops that the smoothing needs after its start
constexpr std::int64_t kFirstFloor = 60;  // hops before a level is believed
constexpr std::int64_t kBlockHops = 50;   // half a second; the minimum is over 8 of these
constexpr std::ptrdiff_t kAlike = 9;      // bands beside the softest that must rest at its level
constexpr float kEven = 1.6F;             // their minimum at most, times the softest's
constexpr float kNever = std::numeric_limits<float>::max();  // minimum of a block without hops

// Minimum of both, band by band, into `least`.
void lower(NoiseFloor::Bands& least, const NoiseFloor::Bands& bands) noexcept {
    std::transform(least.begin(), least.end(), bands.begin(), least.begin(), [](float a, float b) {
        return std::min(a, b);
    });
}

}  // namespace

NoiseFloor::NoiseFloor() : white_(OnsetDetector::white_magnitudes()) { reset(); }

void NoiseFloor::reset() noexcept RAKS_NONBLOCKING {
    smoothed_ = {};
    quiet_ = {};
    least_.fill(kNever);
    for (Bands& block : blocks_) {
        block.fill(kNever);
    }
    hops_ = 0;
    level_ = 0.0F;
}

const NoiseFloor::Bands& NoiseFloor::subtract(std::span<const float, kBands> magnitudes) noexcept
    RAKS_NONBLOCKING {
    // Minima of single hops would lie far under the noise's mean: a first-order low-pass comes
    // first.
    for (std::size_t band = 0; band < kBands; ++band) {
        smoothed_[band] = hops_ == 0
                              ? magnitudes[band]
                              : smoothed_[band] + kSmoothing * (magnitudes[band] - smoothed_[band]);
    }
    ++hops_;
    if (hops_ > kSettled) {
        keep_least();
    }
    // The minimum over little time is no noise floor yet.
    level_ = hops_ < kFirstFloor ? 0.0F : level_under();
    for (std::size_t band = 0; band < kBands; ++band) {
        const float noise = level_ * white_[band];
        // Powers add up, magnitudes do not.
        const float power = magnitudes[band] * magnitudes[band] - noise * noise;
        quiet_[band] = level_ > 0.0F ? std::sqrt(std::max(0.0F, power)) : magnitudes[band];
    }
    return quiet_;
}

// Minimum statistics: the minima of blocks in a ring give the minimum of the last 4 s.
void NoiseFloor::keep_least() noexcept {
    lower(least_, smoothed_);
    if (hops_ % kBlockHops == 0) {
        blocks_[static_cast<std::size_t>(hops_ / kBlockHops) % kBlocks] = least_;
        least_.fill(kNever);
    }
}

// Level of the white noise under the last 4 s, or 0.
float NoiseFloor::level_under() const noexcept {
    Bands least = least_;
    for (const Bands& block : blocks_) {
        lower(least, block);
    }
    // Over white noise's shape the minima of all bands that hold nothing else are equal.
    std::transform(
        least.begin(), least.end(), white_.begin(), least.begin(), std::divides<float>());
    std::nth_element(least.begin(), least.begin() + kAlike, least.end());
    const float level = *std::min_element(least.begin(), least.begin() + kAlike);
    // Reverberation leaves a floor, too, but not of one level in all bands.
    return least[kAlike] <= kEven * level ? level : 0.0F;
}

}  // namespace raks::audio
