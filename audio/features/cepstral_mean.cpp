#include "audio/features/cepstral_mean.hpp"

#include <algorithm>

#include "base/time.hpp"

namespace raks::audio {

CepstralMean::CepstralMean(const CepstralMeanConfig& config) noexcept
    // `longest_`: once this many frames are known, each further one counts 1 / longest_.
    : config_(config), longest_(std::max(1.0, config.seconds * kHopsPerSecond)) {
    reset();
}

void CepstralMean::reset() noexcept RAKS_NONBLOCKING {
    // The start's weight in frames: the first frame of music moves the mean by 1 / (heard_ + 1).
    frames_ = std::max(1.0, config_.start_weight * kHopsPerSecond);
    std::copy(config_.start.begin(), config_.start.end(), mean_.begin());
}

void CepstralMean::normalize(Frame frame, MfccVector& vector) noexcept RAKS_NONBLOCKING {
    if (frame == Frame::music) {
        // A plain mean until the time constant is reached, then an exponential one.
        frames_ = std::min(frames_ + 1.0, longest_);
        const double share = 1.0 / frames_;
        for (std::size_t i = 0; i < mean_.size(); ++i) {
            mean_[i] += share * (static_cast<double>(vector[i]) - mean_[i]);
        }
    }
    // Silence is normalized, too, with the mean as it stands: every frame has a vector.
    for (std::size_t i = 0; i < mean_.size(); ++i) {
        vector[i] = static_cast<float>(static_cast<double>(vector[i]) - mean_[i]);
    }
}

}  // namespace raks::audio
