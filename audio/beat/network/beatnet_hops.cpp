#include "audio/beat/network/beatnet_hops.hpp"

#include <algorithm>

namespace raks::audio {

static_assert(OnsetDetector::kSampleRate == BeatNetStream::kSampleRate);
static_assert(OnsetDetector::kHop + OnsetDetector::kHop == BeatNetStream::kHop);

void BeatNetHops::reset() noexcept RAKS_NONBLOCKING {
    stream_.reset();
    samples_.fill(0.0F);
    to_frame_ = kFirstFrame;
    newest_ = before_ = {};
}

// Of each window only the last hop is new; the overlap is written once more.
BeatNetEvidence BeatNetHops::next(std::span<const float, OnsetDetector::kWindow> window) noexcept
    RAKS_NONBLOCKING {
    std::copy(samples_.begin() + kHop, samples_.end(), samples_.begin());
    std::copy(window.begin(), window.end(), samples_.end() - OnsetDetector::kWindow);
    if (to_frame_ > 0) {
        --to_frame_;
        return newest_;
    }
    to_frame_ = 1;
    before_ = newest_;
    newest_ = stream_.next(std::span(samples_).first<BeatNetStream::kWindow>());
    return {0.5F * (before_.beat + newest_.beat), 0.5F * (before_.downbeat + newest_.downbeat)};
}

}  // namespace raks::audio
