#pragma once

#include <cstdint>
#include <type_traits>

#include "base/beats.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// The slowest and the fastest tempo that the beat tracker follows.
inline constexpr Bpm kSlowestTempo{50.0};
inline constexpr Bpm kFastestTempo{230.0};

/// What a user tells the beat tracker. Takes effect at `time`, or at once when that has passed.
struct AnalyzerCommand {
    enum class Kind : std::uint8_t {
        tap,           ///< a beat was tapped at `time`; from the third on, taps set tempo and phase
        half_tempo,    ///< every other beat from here on
        double_tempo,  ///< twice as many
        nudge,         ///< beats move by `value` seconds (positive: later), |value| <= 0.5
        resync_bar,    ///< the beat nearest to `time` is count 1
        set_tempo,     ///< `value` BPM, clamped to those two, held until release_tempo
        hold_tempo,    ///< the tempo of now, until release_tempo
        release_tempo,  ///< follow the music again
        hint_genre,     ///< tempi of dance number `value` are likelier when one is sought
    };
    Kind kind = Kind::tap;
    StreamTime time{};
    double value = 0.0;
};
static_assert(std::is_trivially_copyable_v<AnalyzerCommand>);

}  // namespace raks::audio
