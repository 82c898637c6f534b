#include "audio/features/rhythm_frames.hpp"

#include <algorithm>

namespace raks::audio {

Expected<void> RhythmFrames::prepare(SampleRate rate) {
    // Half a window of zeros first: window 0 is centred on the first sample.
    std::fill(window_.begin(), window_.end(), 0.0F);
    filled_ = kWindow / 2;
    return resampler_.prepare(rate, SampleRate(kSampleRate));
}

// The window's second half has to arrive after its middle, and the resampler delays all samples.
Nanos RhythmFrames::delay() const noexcept {
    return resampler_.delay() + SampleRate(kSampleRate).time_of(kWindow / 2).time_since_epoch();
}

void RhythmFrames::advance() noexcept {
    std::copy(window_.begin() + kHop, window_.end(), window_.begin());
    filled_ -= kHop;
}

}  // namespace raks::audio
