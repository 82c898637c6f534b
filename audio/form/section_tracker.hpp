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
    int beat = 50;     ///< one beat
    int bar = 200;     ///< one bar, or two where bars are short
    int phrase = 800;  ///< four bars
};

/// Tells in which part of its form music is while it sounds: with the whole band, without its
/// rhythm section, or rising towards a drop. It compares the last bar with the fuller bars of the
/// last three quarters of a minute. A song that begins calm has a drop, too, where its band comes
/// in. Threads: one. Real-time: yes.
class SectionTracker {
 public:
    /// The next hop that sounds, or that is in a gap which may become a stop (`is_gap`): a
    /// breakdown is not told there. Returns what became known: breakdown, build_up, drop or none.
    MusicEvent advance(HopIndex hop,
                       const HopSound& sound,
                       const BeatLengths& lengths,
                       bool is_gap) noexcept RAKS_NONBLOCKING;
    /// Music stops: what seemed a drop just before was a last chord.
    void pause(HopIndex hop, const BeatLengths& lengths) noexcept RAKS_NONBLOCKING;
    /// Music goes on after a stop.
    void go_on(HopIndex hop) noexcept RAKS_NONBLOCKING;
    /// The part of the music that sounds: playing, breakdown or build_up.
    [[nodiscard]] MusicPart part() const noexcept { return part_; }
    /// Forgets the stream.
    void reset() noexcept { *this = SectionTracker(); }

 private:
    static constexpr std::size_t kRemembered = 225;  // values: 45 s, each 0.2 s

    void remember(const StretchSound& bar) noexcept;
    [[nodiscard]] MusicEvent listen(HopIndex hop, const BeatLengths& lengths, bool is_gap) noexcept;
    [[nodiscard]] MusicEvent wait(HopIndex hop, const BeatLengths& lengths) noexcept;
    [[nodiscard]] bool has_come_in() noexcept;
    [[nodiscard]] bool is_drop(HopIndex hop, const BeatLengths& lengths) const noexcept;
    [[nodiscard]] HopIndex place_of_fall(const BeatLengths& lengths) const noexcept;
    [[nodiscard]] HopIndex place_of_drop(HopIndex hop, const BeatLengths& lengths) const noexcept;
    [[nodiscard]] HopIndex place_of_rise(HopIndex hop, const BeatLengths& lengths) const noexcept;
    [[nodiscard]] bool is_end_of_phrase(HopIndex hop, const BeatLengths& lengths) const noexcept;
    void enter(MusicPart part, HopIndex hop) noexcept;

    MusicPart part_ = MusicPart::playing;
    HopIndex entered_ = 0;  // hop at which the present part was told
    HopSums sums_;
    std::array<HopIndex, HopSums::kKept> hops_{};  // of the hops in sums_, ring
    std::array<float, HopSums::kKept> hits_{};     // likewise, of all bands
    std::size_t count_ = 0;
    int full_hops_ = 0;           // in a row in which the last bar of a breakdown was full
    int fallen_hops_ = 0;         // in a row in which the last bar was a breakdown
    HopIndex fell_ = 0;           // hop at which the present breakdown began
    std::size_t fell_count_ = 0;  // count_ there
    MusicPart before_ = MusicPart::playing;  // the part before the present one
    HopIndex went_on_ = -1;  // hop of the entry after a stop in it; -1: there was none

    RunningRange<kRemembered> low_, level_, top_, low_onsets_, onsets_;  // of bars
    FullBand full_;                                                      // what they have
    int come_in_hops_ = 0;                // in a row in which a calm begin seemed to be over
    std::size_t may_come_in_from_ = 800;  // count_ from which on that can be so
    StretchSound calm_;                   // the softest bar of the present breakdown
    HopIndex calm_hop_ = 0;               // at the end of that bar
};

}  // namespace raks::audio
