#pragma once

#include <array>
#include <cstddef>

#include "audio/form/hop_sums.hpp"
#include "audio/form/running_range.hpp"
#include "audio/form/section_rules.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// Lengths in hops by the beat grid.
struct BeatLengths {
    int beat = 50;  ///< one beat
    int bar = 200;  ///< one bar, or about 2 s where bars are short
};

/// Tells in which part of its form music is while it sounds: with the whole band, without its
/// rhythm section, or rising towards a drop. It compares the last bar with the fuller bars of the
/// last three quarters of a minute. Threads: one. Real-time: yes.
class SectionTracker {
 public:
    /// The next hop that sounds. Returns what became known: breakdown, build_up, drop or none.
    MusicEvent advance(HopIndex hop,
                       const HopSound& sound,
                       const BeatLengths& lengths) noexcept RAKS_NONBLOCKING;
    /// The part of the music that sounds: playing, breakdown or build_up.
    [[nodiscard]] MusicPart part() const noexcept { return part_; }
    /// Forgets the stream.
    void reset() noexcept { *this = SectionTracker(); }

 private:
    static constexpr std::size_t kRemembered = 225;  // values: 45 s, each 0.2 s

    void remember(const StretchSound& bar) noexcept;
    [[nodiscard]] MusicEvent listen(HopIndex hop, const BeatLengths& lengths) noexcept;
    [[nodiscard]] MusicEvent wait(HopIndex hop, const BeatLengths& lengths) noexcept;
    [[nodiscard]] HopIndex place_of_fall(const BeatLengths& lengths) const noexcept;
    [[nodiscard]] HopIndex place_of_drop(const BeatLengths& lengths) const noexcept;
    void enter(MusicPart part, HopIndex hop) noexcept;

    MusicPart part_ = MusicPart::playing;
    HopIndex entered_ = 0;  // hop at which the present part was told
    HopSums sums_;
    std::array<HopIndex, HopSums::kKept> hops_{};  // of the hops in sums_, ring
    std::array<float, HopSums::kKept> hits_{};     // likewise, of all bands
    std::size_t count_ = 0;
    int fallen_hops_ = 0;  // in a row in which the last bar was a breakdown

    RunningRange<kRemembered> low_, level_, low_onsets_, onsets_;  // of bars
    StretchSound full_;                                            // their higher values
    StretchSound calm_;      // the softest bar of the present breakdown
    HopIndex calm_hop_ = 0;  // at the end of that bar
};

}  // namespace raks::audio
