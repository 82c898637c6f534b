#include "audio/form/last_chord.hpp"

#include <algorithm>

#include "audio/form/accent_detector.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kHopsASecond = 100;
// An onset this strong beside the usual strongest of a second belongs to the song, not to a decay.
constexpr float kOfTheSong = 0.45F;
// The chord itself is not what follows it: hops that are left out, and hops that tell.
constexpr HopIndex kOwnHops = 30;
constexpr HopIndex kTellingHops = 150;
// In a fade-out onsets of this share of the usual ones go on.
constexpr float kFadeShare = 0.28F;
// What is so many dB under the loudest of late, which falls by so many a hop, is not heard; nor
// what is under the last.
constexpr float kHeardDecibels = 30.0F;
constexpr float kHeardFallDecibels = 0.06F;
constexpr float kLeastHeard = -72.0F;

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
    loud_ = std::max(sound.level, loud_ - kHeardFallDecibels);
    if (sound.level > std::max(loud_ - kHeardDecibels, kLeastHeard)) {
        heard_ = hop;
    }
    if (peak < AccentDetector::kLeast) {
        return;
    }
    block = std::max(block, peak);
    const float usual = usual_strength();
    if (peak >= kOfTheSong * usual) {
        chord_ = hop;
        goes_on_ = false;
    } else if (hop > chord_ + kOwnHops && hop <= chord_ + kTellingHops) {
        goes_on_ = goes_on_ || peak >= kFadeShare * usual;
    }
}

HopIndex LastChord::hop() const noexcept { return goes_on_ ? heard_ : chord_; }

}  // namespace raks::audio
