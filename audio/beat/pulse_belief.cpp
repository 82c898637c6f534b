#include "audio/beat/pulse_belief.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

constexpr int kSettledBeats = 6;        // from which a pulse can be told
constexpr int kBelievedBeats = 10;      // memory of the belief
constexpr float kMarginCounts = 0.04F;  // of a nat of margin
constexpr float kSurelyBetter = 0.6F;   // probability of a rival that is taken

// How often a tracker follows a pulse while another is the beat, against how often in training, by
// kind of the other; 1 where it follows the beat.
constexpr std::array<float, kRivalKinds> kShareOfFault = {0.02F,   // twice
                                                          0.36F,   // half
                                                          0.24F,   // off_beat
                                                          0.06F,   // third_off
                                                          0.03F,   // quarter_off
                                                          0.02F,   // three_for_two
                                                          0.32F,   // two_for_three
                                                          0.02F,   // thrice
                                                          0.08F};  // one_for_three

}  // namespace

PulseEvidence seen_from_zero(const PulseEvidence& evidence, long number) noexcept {
    PulseEvidence seen{};
    for (std::size_t pulse = 0; pulse < seen.size(); ++pulse) {
        seen[pulse] = evidence[place_at(pulse, number)];
    }
    return seen;
}

void weigh_as_followed(PulseEvidence& evidence) noexcept {
    float sum = evidence[0];
    for (std::size_t rival = 0; rival < kRivalPulses.size(); ++rival) {
        evidence[1 + rival] *= kShareOfFault[static_cast<std::size_t>(kRivalPulses[rival].kind)];
        sum += evidence[1 + rival];
    }
    for (float& probability : evidence) {
        probability /= sum;
    }
}

void weigh_by_margins(const PulseMargins& margins, PulseEvidence& evidence) noexcept {
    float sum = evidence[0];
    for (std::size_t rival = 0; rival < kRivalPulses.size(); ++rival) {
        evidence[1 + rival] *= std::exp(-kMarginCounts * std::max(0.0F, margins.margin(rival)));
        sum += evidence[1 + rival];
    }
    for (float& probability : evidence) {
        probability /= sum;
    }
}

void PulseBelief::observe(long number, const PulseEvidence& evidence) noexcept RAKS_NONBLOCKING {
    PulseEvidence seen = seen_from_zero(evidence, number);
    weigh_as_followed(seen);
    // What is said at the first beats is forgotten once more is known.
    beats_ = std::min(beats_ + 1, kBelievedBeats);
    const float share = 1.0F / static_cast<float>(beats_);
    for (std::size_t pulse = 0; pulse < seen.size(); ++pulse) {
        mean_[pulse] += share * (seen[pulse] - mean_[pulse]);
    }
}

float PulseBelief::right() const noexcept { return beats_ < kSettledBeats ? 0.5F : mean_[0]; }

std::optional<RivalPulse> PulseBelief::better(const PulseMargins& margins) const noexcept {
    PulseEvidence weighed = mean_;
    weigh_by_margins(margins, weighed);
    const auto best = std::max_element(weighed.begin(), weighed.end());
    if (beats_ < kSettledBeats || best == weighed.begin() || *best < kSurelyBetter) {
        return std::nullopt;
    }
    return pulse_at(static_cast<std::size_t>(best - weighed.begin()));
}

}  // namespace raks::audio
