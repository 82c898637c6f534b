#include "audio/features/rhythm_frames.hpp"

#include <algorithm>

namespace raks::audio {

Expected<void> RhythmFrames::prepare(SampleRate rate) {
    std::fill(window_.begin(), window_.end(), 0.0F);
    filled_ = kWindow / 2;
    return resampler_.prepare(rate, SampleRate(kSampleRate));
}

Nanos RhythmFrames::delay() const noexcept {
    return resampler_.delay() + SampleRate(kSampleRate).time_of(kWindow / 2).time_since_epoch();
}

void RhythmFrames::advance() noexcept {
    std::copy(window_.begin() + kHop, window_.end(), window_.begin());
    filled_ -= kHop;
}

}  // namespace raks::audio
