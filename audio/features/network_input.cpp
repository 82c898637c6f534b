#include "audio/features/network_input.hpp"

#include <algorithm>
#include <numeric>

#include "audio/features/log_magnitudes.hpp"

namespace raks::audio {
namespace {

// The running level follows a louder sound within some 20 hops but a softer one within some 500, so
// that a soft passage still looks soft.
constexpr float kRise = 1.0F / 20.0F;  // of the difference, a hop
constexpr float kFall = 1.0F / 500.0F;
constexpr float kLowestLevel = 0.05F;      // lowest level: silence is not scaled up
constexpr float kInputCompression = 8.0F;  // log(1 + 8 x magnitude / level)
constexpr float kRiseGain = 2.0F;          // factor of the rises
constexpr float kMiddle = 0.8F;            // of the compressed magnitudes; subtracted

}  // namespace

NetworkInput::Frame NetworkInput::next(std::span<const float> mel_magnitudes) noexcept
    RAKS_NONBLOCKING {
    const float mean = std::accumulate(mel_magnitudes.begin(), mel_magnitudes.end(), 0.0F) /
                       static_cast<float>(kBands);
    // Level of the spectrum, over which all magnitudes are taken.
    level_ += (mean > level_ ? kRise : kFall) * (mean - level_);
    const float scale = kInputCompression / std::max(level_, kLowestLevel);
    Bands now{};
    log_magnitudes(mel_magnitudes.first(kBands), scale, now);
    // Start of the stream: no earlier hop to compare with.
    if (hops_ < 2) {
        history_[static_cast<std::size_t>(hops_)] = now;
    }
    hops_ = std::min(hops_ + 1, 2);
    const Bands& before = history_[0];
    Frame frame{};
    for (std::size_t band = 0; band < kBands; ++band) {
        // The maximum over the neighbouring bands: a vibrato that moves to the next band is no
        // onset.
        const float left = before[band > 0 ? band - 1 : 0];
        const float right = before[band + 1 < kBands ? band + 1 : band];
        frame[band] = kRiseGain * std::max(0.0F, now[band] - std::max({left, before[band], right}));
    }
    for (std::size_t pair = 0; pair < kBands / 2; ++pair) {
        frame[kBands + pair] = 0.5F * (now[2 * pair] + now[2 * pair + 1]) - kMiddle;
    }
    history_[0] = history_[1];
    history_[1] = now;
    return frame;
}

}  // namespace raks::audio
