#include "audio/beat/beat_detector.hpp"

#include <algorithm>
#include <span>

namespace raks::audio {
namespace {

constexpr int kRemembered = 500;  // hops: memory of mean and variance
constexpr int kFewest = 200;      // hops that they must contain before a comparison
// Another song is heard where the bands' squared distances, each divided by its variance, exceed
// two thresholds: kChanged in their mean, and kEachWay both in what bands that became louder add to
// that mean and in what bands that became softer add. Where players pause, all bands fall; where
// they come in, all rise; and the beats go on. In another song some bands do each.
constexpr double kChanged = 3.0;
constexpr double kEachWay = 0.5;
constexpr double kVariance = 0.02;  // added to each variance: steady tones have none

}  // namespace

// Running sums over the last window and the one before it: each hop enters one and leaves the
// other.
void SoundChange::slide(std::span<const float, kBands> loudness) noexcept {
    const auto& middle = ring_[(next_ + kWindow) % kKept];
    auto& oldest = ring_[next_];
    for (std::size_t band = 0; band < kBands; ++band) {
        const auto leaves = static_cast<double>(middle[band]);
        newest_[band] += static_cast<double>(loudness[band]) - leaves;
        before_[band] += leaves - static_cast<double>(oldest[band]);
        oldest[band] = loudness[band];
    }
    next_ = (next_ + 1) % kKept;
    hops_ = std::min(hops_ + 1, static_cast<int>(kKept));
}

// Learns from the window before the last: the last one may already be of another song.
void SoundChange::learn() noexcept {
    learnt_ = std::min(learnt_ + 1, kRemembered);
    const double share = 1.0 / learnt_;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double off = before_[band] / kWindow - mean_[band];
        mean_[band] += share * off;
        variance_[band] += share * ((1.0 - share) * off * off - variance_[band]);
    }
}

// Distance of the last window from what was learnt, apart for bands that rose and fell.
bool SoundChange::is_another() const noexcept {
    double louder = 0.0;
    double softer = 0.0;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double off = newest_[band] / kWindow - mean_[band];
        const double distance = off * off / (variance_[band] + kVariance) / kBands;
        (off > 0.0 ? louder : softer) += distance;
    }
    return louder + softer > kChanged && std::min(louder, softer) > kEachWay;
}

// After a change the statistics start anew.
bool SoundChange::add(std::span<const float, kBands> loudness) noexcept RAKS_NONBLOCKING {
    slide(loudness);
    if (hops_ < static_cast<int>(kKept)) {
        return false;
    }
    const bool is_changed = learnt_ > kFewest && is_another();
    if (is_changed) {
        learnt_ = 0;
    }
    learn();
    return is_changed;
}

namespace {

constexpr int kLeastCompared = 100;  // hops: at least one beat of any tempo
constexpr float kSameBeats = 0.5F;   // share of the older stream's evidence that both have
constexpr float kMoreBeats = 1.3F;   // ratio of the younger stream's evidence to the older one's

}  // namespace

BeatDetector::BeatDetector(const std::shared_ptr<const BeatNetwork>& network)
    : streams_{BeatNetworkStream(network), BeatNetworkStream(network)} {
    static_assert(NetworkInput::kSize == NetworkInput::kBands + SoundChange::kBands);
}

void BeatDetector::reset() noexcept RAKS_NONBLOCKING {
    change_.reset();
    streams_[0].reset();
    streams_[1].reset();
    active_ = behind_ = newest_ = 0;
    trial_ = {};
}

// The other stream works only after a change: first to catch up, then in the comparison.
BeatEvidence BeatDetector::next(const NetworkInput::Frame& frame) noexcept RAKS_NONBLOCKING {
    newest_ = (newest_ + 1) % kKept;
    recent_[newest_] = frame;
    const std::span<const float> inputs(frame);
    BeatNetworkStream& younger = streams_[1 - active_];
    // The change is reported about a window late, so the new song's first hops are in the ring.
    if (change_.add(inputs.last<SoundChange::kBands>())) {
        younger.reset();
        trial_ = {};
        behind_ = SoundChange::kWindow;
    } else if (behind_ > 0) {
        ++behind_;
    }
    BeatEvidence evidence = streams_[active_].next(frame);
    // No stream is catching up; the older one runs along only while the two are compared.
    if (behind_ == 0) {
        if (trial_.hops_left > 0) {
            compare(younger.next(frame).beat, evidence.beat);
        }
        return evidence;
    }
    // Catch up: the hops in the ring, oldest first.
    BeatEvidence younger_evidence;
    for (std::size_t i = std::min(kCatchUp, behind_); i > 0; --i) {
        --behind_;
        younger_evidence = younger.next(recent_[(newest_ + kKept - behind_) % kKept]);
    }
    // Caught up: the younger stream is used from here on, on trial.
    if (behind_ == 0) {
        active_ = 1 - active_;
        evidence = younger_evidence;
        trial_ = {.hops_left = kTrial};
    }
    return evidence;
}

// Returns to the older stream when it was the same song, in which players came in or paused: the
// younger one has the same beats and others between them.
void BeatDetector::compare(float older, float younger) noexcept {
    --trial_.hops_left;
    trial_.older += older;
    trial_.younger += younger;
    trial_.both += std::min(older, younger);
    if (kTrial - trial_.hops_left >= kLeastCompared && trial_.both > kSameBeats * trial_.older &&
        trial_.younger > kMoreBeats * trial_.older) {
        active_ = 1 - active_;
        trial_ = {};
    }
}

}  // namespace raks::audio
