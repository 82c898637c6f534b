#pragma once

#include <cstdint>
#include <type_traits>

#include "base/beats.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// The slowest tempo that the beat tracker follows.
inline constexpr Bpm kSlowestTempo{40.0};
/// The fastest tempo that the beat tracker follows.
inline constexpr Bpm kFastestTempo{230.0};

/// Whether the beat tracker follows this tempo.
[[nodiscard]] constexpr bool is_followed(Bpm tempo) noexcept {
    return tempo >= kSlowestTempo && tempo <= kFastestTempo;
}

/// A user's command to the beat tracker. It takes effect at `time`, or at the next hop when that
/// has passed.
struct AnalyzerCommand {
    /// What the command does; some kinds use `value`.
    enum class Kind : std::uint8_t {
        tap,  ///< a beat was tapped at `time`; from the third tap on, taps set tempo and phase
        half_tempo,     ///< every other beat from here on
        double_tempo,   ///< twice as many beats from here on
        three_two,      ///< three beats for two or two for three, whichever the music fits better
        nudge,          ///< beats move by `value` seconds (positive: later), |value| <= 0.5
        resync_bar,     ///< the beat nearest to `time` is count 1
        set_tempo,      ///< `value` BPM, clamped to the range above, held until release_tempo
        hold_tempo,     ///< keeps the present tempo until release_tempo
        release_tempo,  ///< follow the music again
        set_beat,       ///< a beat is at `time`; until release_tempo beats follow no music any more
        hint_genre,     ///< dance number `value`: its tempi become likelier while a tempo is sought
    };
    Kind kind = Kind::tap;  ///< see Kind
    StreamTime time{};      ///< stream time that the command refers to
    double value = 0.0;     ///< unit by kind: seconds, BPM or a dance's number
};
static_assert(std::is_trivially_copyable_v<AnalyzerCommand>);

}  // namespace raks::audio
