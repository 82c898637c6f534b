#include "audio/beat/evidence_fusion.hpp"

#include <algorithm>

namespace raks::audio {
namespace {

constexpr float kOfBeatNet = 0.4F;  // share of the mean
constexpr int kWarmHops = 400;      // in a sound's first seconds BeatNet counts less

// `trust`: of BeatNet, [0, 1].
BeatEvidence fuse(const BeatEvidence& own, const BeatNetEvidence& other, float trust) noexcept {
    const auto mean = [trust](float a, float b) { return a + trust * kOfBeatNet * (b - a); };
    const float no_beat = 1.0F - trust * other.beat;
    return {mean(own.beat, other.beat),
            mean(own.downbeat, other.downbeat),
            own.half * no_beat,
            own.third * no_beat};
}

}  // namespace

EvidenceFusion::EvidenceFusion(const std::shared_ptr<const BeatNetwork>& network)
    : detector_(network), lag_(network->lookahead()) {
    if (network->beatnet()) {
        beatnet_.emplace(network->beatnet());
        lag_ = std::max(network->lookahead(), BeatNetHops::kLag);
        own_wait_ = static_cast<std::size_t>(lag_ - network->lookahead());
        beatnet_wait_ = static_cast<std::size_t>(lag_ - BeatNetHops::kLag);
    }
}

void EvidenceFusion::reset() noexcept RAKS_NONBLOCKING {
    detector_.reset();
    if (beatnet_) {
        beatnet_->reset();
    }
    own_ = {};
    other_ = {};
    heard_ = 0;
}

void EvidenceFusion::jump() noexcept RAKS_NONBLOCKING {
    if (beatnet_) {
        beatnet_->reset();
    }
    heard_ = 0;
}

FusedEvidence EvidenceFusion::next(const NetworkInput::Frame& frame,
                                   std::span<const float, OnsetDetector::kWindow> window) noexcept
    RAKS_NONBLOCKING {
    now_ = (now_ + 1) % kWaiting;
    own_[now_] = detector_.next(frame);
    if (!beatnet_) {
        return {own_[now_], own_[now_]};
    }
    other_[now_] = beatnet_->next(window);
    const BeatEvidence& own = own_[(now_ + kWaiting - own_wait_) % kWaiting];
    heard_ = std::min(heard_ + 1, kWarmHops);
    const float trust = static_cast<float>(heard_) / float{kWarmHops};
    return {own, fuse(own, other_[(now_ + kWaiting - beatnet_wait_) % kWaiting], trust)};
}

}  // namespace raks::audio
