#include "audio/features/network_input.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raks::audio {
namespace {

constexpr float kRise = 1.0F / 20.0F;  // of the level, a hop
constexpr float kFall = 1.0F / 500.0F;
constexpr float kFloor = 0.05F;
constexpr float kInputCompression = 8.0F;
constexpr float kRiseGain = 2.0F;
constexpr float kMiddle = 0.8F;  // of the compressed magnitudes

}  // namespace

NetworkInput::Frame NetworkInput::next(std::span<const float> mel_magnitudes) noexcept
    RAKS_NONBLOCKING {
    const float mean = std::accumulate(mel_magnitudes.begin(), mel_magnitudes.end(), 0.0F) /
                       static_cast<float>(kBands);
    level_ += (mean > level_ ? kRise : kFall) * (mean - level_);
    const float scale = kInputCompression / std::max(level_, kFloor);
    Bands now{};
    for (std::size_t band = 0; band < kBands; ++band) {
        now[band] = std::log1p(scale * mel_magnitudes[band]);
    }
    if (hops_ < 2) {
        history_[static_cast<std::size_t>(hops_)] = now;
    }
    hops_ = std::min(hops_ + 1, 2);
    const Bands& before = history_[0];
    Frame frame{};
    for (std::size_t band = 0; band < kBands; ++band) {
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
