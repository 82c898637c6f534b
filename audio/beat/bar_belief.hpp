#pragma once

#include <array>

#include "audio/beat/network/bar_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Which beat of the bar comes next, and how many a bar has: a forward recursion over metre x
/// position, one step a beat, fed with how much each beat sounded like a downbeat, how much the
/// sound changed at it and what a network says of its place. The metre may change at a downbeat.
///
/// Threads: one. Real-time: yes.
class BarBelief {
 public:
    BarBelief() noexcept { reset(); }

    /// The next beat comes, and nothing is known of it yet: beat `number`, counted up by one each
    /// time (a jump of the count moves the bar along).
    void next_beat(long number) noexcept RAKS_NONBLOCKING;

    /// The last beat was a downbeat with this probability, [0, 1]. The middle of a bar of 4 or 6
    /// may sound like one, too: such bars are not taken for two short ones for that.
    void observe_downbeat(float probability) noexcept RAKS_NONBLOCKING;

    /// The sound changed so much at the last beat, see BeatChange.
    void observe_change(float deviations) noexcept RAKS_NONBLOCKING;

    /// A network's opinion of the last beat.
    void observe_bar(const BarEvidence& evidence) noexcept RAKS_NONBLOCKING;

    /// The user says which beat is the first of a bar: held until reset().
    void hold(long number) noexcept RAKS_NONBLOCKING;

    /// The beats were counted anew (at another octave): this one is a downbeat of the same bars.
    void recount(long origin) noexcept RAKS_NONBLOCKING;

    [[nodiscard]] int beats_per_bar() const noexcept { return beats_per_bar_; }
    /// A beat number that is a downbeat.
    [[nodiscard]] long origin() const noexcept { return origin_; }
    /// Probability of the place in the bar that is told.
    [[nodiscard]] float confidence() const noexcept { return confidence_; }

    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::array kMetres = {2, 3, 4, 6};
    static constexpr std::size_t kLongest = 6;
    using Positions = std::array<float, kLongest>;

    void step() noexcept;
    void weigh(float first, float middle, float other) noexcept;
    void tell() noexcept;

    std::array<Positions, kMetres.size()> probability_{};
    long number_ = 0;
    bool has_beat_ = false;
    bool is_held_ = false;
    int beats_per_bar_ = 4;
    long origin_ = 0;
    float confidence_ = 0.0F;
};

}  // namespace raks::audio
