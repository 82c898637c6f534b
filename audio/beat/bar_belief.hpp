#pragma once

#include <array>

#include "audio/beat/network/bar_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Estimates the bar position of each beat and the number of beats a bar: a forward recursion over
/// metre x position, one step a beat. Its evidence: the probability of a downbeat, the change of
/// the sound at the beat, and a network's bar evidence. The metre may change at a downbeat.
///
/// Threads: one. Real-time: yes.
class BarBelief {
 public:
    /// Starts from the prior of metres.
    BarBelief() noexcept { reset(); }

    /// Moves on to beat `number`, of which nothing is known yet. Numbers count up by one; where one
    /// is skipped, the bar position moves along.
    void next_beat(long number) noexcept RAKS_NONBLOCKING;

    /// Evidence: the last beat was a downbeat with this probability, [0, 1]. The middle of a bar of
    /// 4 or 6 may have the evidence of a downbeat, too, so such bars are not mistaken for two short
    /// ones.
    void observe_downbeat(float probability) noexcept RAKS_NONBLOCKING;

    /// Evidence: how much the sound changed at the last beat, in standard deviations, see
    /// BeatChange.
    void observe_change(float deviations) noexcept RAKS_NONBLOCKING;

    /// Evidence: a network's probabilities of the last beat's place in its bar.
    void observe_bar(const BarEvidence& evidence) noexcept RAKS_NONBLOCKING;

    /// The user sets beat `number` as a downbeat: held until reset().
    void hold(long number) noexcept RAKS_NONBLOCKING;

    /// The beats have other numbers from here on (half or double tempo); beat `origin` is a
    /// downbeat of the same bars. The probabilities start anew.
    void recount(long origin) noexcept RAKS_NONBLOCKING;

    /// Most likely metre: 2, 3, 4 or 6.
    [[nodiscard]] int beats_per_bar() const noexcept { return beats_per_bar_; }
    /// A beat number that is a downbeat.
    [[nodiscard]] long origin() const noexcept { return origin_; }
    /// Posterior probability of the published metre and position; 1 when held by the user.
    [[nodiscard]] float confidence() const noexcept { return confidence_; }

    /// Back to the prior; releases hold().
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::array kMetres = {2, 3, 4, 6};  // beats a bar
    static constexpr std::size_t kLongest = 6;
    using Positions = std::array<float, kLongest>;  // probability by bar position

    void step() noexcept;
    void weigh(float first, float middle, float other) noexcept;
    void tell() noexcept;

    std::array<Positions, kMetres.size()> probability_{};  // by metre
    long number_ = 0;                                      // of the last beat
    bool has_beat_ = false;
    bool is_held_ = false;   // by the user
    int beats_per_bar_ = 4;  // published
    long origin_ = 0;        // published: number of a downbeat
    float confidence_ = 0.0F;
};

}  // namespace raks::audio
