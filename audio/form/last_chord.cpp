#include "audio/form/last_chord.hpp"

#include <algorithm>

#include "audio/form/accent_detector.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kHopsASecond = 100;
// An onset this strong beside the usual strongest of a second belongs to the song, not to a decay.
constexpr float kOfTheSong = 0.45F;
// The usual novelty is followed by this share a hop: over 4 s.
constexpr float kNoveltyShare = 1.0F / 400.0F;
// The chord itself is not what follows it: hops that are left out, and hops that tell.
constexpr HopIndex kOwnHops = 30;
constexpr int kTellingHops = 400;
// So much of the usual novelty goes on in a fade-out.
constexpr float kFadeShare = 0.6F;

}  // namespace

// Of the last seconds that had an onset: most of them may be of the decay.
float LastChord::usual_strength() const noexcept {
    std::array<float, kSeconds> seconds = strongest_;
    auto* const end = std::remove(seconds.begin(), seconds.end(), 0.0F);
    if (end == seconds.begin()) {
        return 0.0F;
    }
    auto* const strong = seconds.begin() + 3 * (end - seconds.begin()) / 4;
    std::nth_element(seconds.begin(), strong, end);
    return *strong;
}

void LastChord::advance(HopIndex hop, const HopSound& sound, float peak) noexcept RAKS_NONBLOCKING {
    const std::size_t second = hops_ / kHopsASecond;
    float& block = strongest_[second % kSeconds];
    if (hops_ % kHopsASecond == 0) {
        block = 0.0F;
    }
    ++hops_;
    const float novelty = sound.total_novelty();
    if (hop > chord_ + kOwnHops && hops_after_ < kTellingHops) {
        novelty_after_ += novelty;
        ++hops_after_;
    }
    usual_novelty_ += kNoveltyShare * (novelty - usual_novelty_);
    if (peak < AccentDetector::kLeast) {
        return;
    }
    block = std::max(block, peak);
    const float of_late = std::max({block,
                                    strongest_[(second + kSeconds - 1) % kSeconds],
                                    strongest_[(second + kSeconds - 2) % kSeconds]});
    if (peak >= AccentDetector::kStandsOut * of_late) {
        heard_ = hop;
    }
    if (peak >= kOfTheSong * usual_strength()) {
        chord_ = hop;
        novelty_before_ = usual_novelty_;
        novelty_after_ = 0.0F;
        hops_after_ = 0;
    }
}

HopIndex LastChord::hop() const noexcept {
    const bool goes_on =
        hops_after_ > 0 && novelty_after_ > kFadeShare * novelty_before_ * static_cast<float>(hops_after_);
    return goes_on ? heard_ : chord_;
}

}  // namespace raks::audio
