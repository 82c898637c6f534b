#include "audio/beat/song_listener.hpp"

#include <algorithm>
#include <span>

namespace raks::audio {

SongListener::SongListener(const std::shared_ptr<const BeatNetwork>& network)
    : streams_{BeatListener(network), BeatListener(network)} {
    static_assert(NetworkInput::kSize == NetworkInput::kBands + SoundChange::kBands);
}

void SongListener::reset() noexcept RAKS_NONBLOCKING {
    change_.reset();
    streams_[0].reset();
    streams_[1].reset();
    heard_ = behind_ = newest_ = 0;
}

BeatEvidence SongListener::next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING {
    newest_ = (newest_ + 1) % kKept;
    recent_[newest_] = frame;
    const std::span<const float> inputs(frame);
    BeatListener& younger = streams_[1 - heard_];
    if (change_.hear(inputs.last<SoundChange::kBands>())) {
        younger.reset();
        behind_ = SoundChange::kWindow;
    } else if (behind_ > 0) {
        ++behind_;
    }
    BeatEvidence evidence = streams_[heard_].next(frame);
    if (behind_ == 0) {
        return evidence;
    }
    BeatEvidence younger_evidence;
    for (std::size_t i = std::min(kCatchUp, behind_); i > 0; --i) {
        --behind_;
        younger_evidence = younger.next(recent_[(newest_ + kKept - behind_) % kKept]);
    }
    if (behind_ == 0) {
        heard_ = 1 - heard_;
        evidence = younger_evidence;
    }
    return evidence;
}

}  // namespace raks::audio
