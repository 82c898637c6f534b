#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "audio/beat/network/beat_network.hpp"
#include "audio/beat/network/rival_list.hpp"
#include "audio/beat/pointer_states.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// How well one pulse explains music, with beats of two and with beats of three parts: ln
/// likelihoods over that of no beat at all, summed over hops.
struct PulseFit {
    float in_two = 0.0F;
    float in_three = 0.0F;
    /// Of the parts that fit better.
    [[nodiscard]] float best() const noexcept { return in_two > in_three ? in_two : in_three; }
};
/// Of the beat, then of each rival.
using PulseFits = std::array<PulseFit, 1 + kRivalPulses.size()>;

/// How well all pulses explain one hop, by the pointer's likelihoods: `position` of the beat in
/// beats, hops a beat, and the hop's evidence. Real-time: yes.
[[nodiscard]] PulseFits fit_pulses(double position,
                                   double period_hops,
                                   const EvidenceLikelihood& evidence) noexcept RAKS_NONBLOCKING;

/// How much better the beat explains a stretch of music than each rival.
///
/// Threads: one. Real-time: yes.
class PulseMargins {
 public:
    PulseMargins() = default;  ///< no music yet
    /// Of fits that were summed elsewhere.
    explicit PulseMargins(const PulseFits& sums) noexcept : sums_(sums) {}

    /// Adds one hop. What was added before counts `keep` of itself, (0, 1].
    void add(const PulseFits& fits, float keep) noexcept RAKS_NONBLOCKING;

    /// Nats by which the beat is better than rival number `rival`; negative: it is worse.
    [[nodiscard]] float margin(std::size_t rival) const noexcept;
    /// The rival with the least margin among those for which `is_wanted(rival)` is true, at least
    /// one.
    template <typename IsWanted>
    [[nodiscard]] RivalPulse likeliest(IsWanted is_wanted) const noexcept {
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < kRivalPulses.size(); ++i) {
            if (is_wanted(kRivalPulses[i]) && (!best || margin(i) < margin(*best))) {
                best = i;
            }
        }
        return kRivalPulses[best.value_or(0)];
    }
    /// Nats by which it is better than no beat at all.
    [[nodiscard]] float over_none() const noexcept;
    /// Nats by which beats of three parts are better than beats of two.
    [[nodiscard]] float for_three() const noexcept { return sums_[0].in_three - sums_[0].in_two; }
    /// Forgets the music.
    void reset() noexcept RAKS_NONBLOCKING { *this = PulseMargins(); }

 private:
    PulseFits sums_{};
};

}  // namespace raks::audio
