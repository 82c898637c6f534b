#include "audio/features/noise_floor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

namespace raks::audio {
namespace {

constexpr float kSmoothing = 0.1F;     // a hop
constexpr std::int64_t kSettled = 30;  // hops: what is smoothed knows nothing before
constexpr std::int64_t kFirstFloor = 60;
constexpr std::int64_t kBlockHops = 50;
constexpr std::ptrdiff_t kAlike = 9;  // bands that hear nothing but noise at times, at the least
constexpr float kEven = 1.6F;         // times the softest of them
constexpr float kNever = std::numeric_limits<float>::max();

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
    for (std::size_t band = 0; band < kBands; ++band) {
        smoothed_[band] = hops_ == 0
                              ? magnitudes[band]
                              : smoothed_[band] + kSmoothing * (magnitudes[band] - smoothed_[band]);
    }
    ++hops_;
    if (hops_ > kSettled) {
        keep_least();
    }
    level_ = hops_ < kFirstFloor ? 0.0F : level_under();
    for (std::size_t band = 0; band < kBands; ++band) {
        const float noise = level_ * white_[band];
        // Powers add up, magnitudes do not.
        const float power = magnitudes[band] * magnitudes[band] - noise * noise;
        quiet_[band] = level_ > 0.0F ? std::sqrt(std::max(0.0F, power)) : magnitudes[band];
    }
    return quiet_;
}

void NoiseFloor::keep_least() noexcept {
    lower(least_, smoothed_);
    if (hops_ % kBlockHops == 0) {
        blocks_[static_cast<std::size_t>(hops_ / kBlockHops) % kBlocks] = least_;
        least_.fill(kNever);
    }
}

float NoiseFloor::level_under() const noexcept {
    Bands least = least_;
    for (const Bands& block : blocks_) {
        lower(least, block);
    }
    std::transform(
        least.begin(), least.end(), white_.begin(), least.begin(), std::divides<float>());
    std::nth_element(least.begin(), least.begin() + kAlike, least.end());
    const float level = *std::min_element(least.begin(), least.begin() + kAlike);
    // The echoes of a room lie under everything, too, but not alike in all bands.
    return least[kAlike] <= kEven * level ? level : 0.0F;
}

}  // namespace raks::audio
