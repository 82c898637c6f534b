#pragma once

#include <array>
#include <optional>

#include "audio/beat/network/pulse_network.hpp"
#include "audio/beat/rival_pulses.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Which pulse is the beat, from what the pulse network said at all beats so far. The pulse that is
/// followed counts more than its rivals: it has the evidence of single beats for it.
///
/// Threads: one. Real-time: yes.
class PulseBelief {
 public:
    /// What the network said at followed beat `number`; numbers go up by one.
    void observe(long number, const PulseEvidence& evidence) noexcept RAKS_NONBLOCKING;

    /// Probability that the followed pulse is the beat; 0.5 before enough is known.
    [[nodiscard]] float right() const noexcept;
    /// The rival that is the beat in all likelihood, as seen from beat number 0; nothing: none is.
    [[nodiscard]] std::optional<RivalPulse> better(const PulseMargins& margins) const noexcept;
    /// Of the followed pulse and of each rival as seen from beat number 0; they sum to 1.
    [[nodiscard]] const PulseEvidence& probabilities() const noexcept { return mean_; }

    /// Another pulse is followed, or other music.
    void reset() noexcept RAKS_NONBLOCKING { *this = PulseBelief(); }

 private:
    PulseEvidence mean_{};
    int beats_ = 0;  // so far, at most those that the mean remembers
};

/// The evidence of followed beat `number` as seen from beat number 0.
[[nodiscard]] PulseEvidence seen_from_zero(const PulseEvidence& evidence, long number) noexcept;

/// What is likelier where a tracker follows a pulse than in the network's training.
void weigh_as_followed(PulseEvidence& evidence) noexcept;

/// The more the evidence of single beats speaks for the followed pulse, the less a rival counts.
void weigh_by_margins(const PulseMargins& margins, PulseEvidence& evidence) noexcept;

}  // namespace raks::audio
