#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "base/beat_grid.hpp"
#include "base/dance_list.hpp"
#include "base/time.hpp"

namespace raks {

/// Dances that one genre model tells apart, at most.
inline constexpr std::size_t kMostGenres = 16;
/// By class of the genre model: its genres, then "none of them". Natural logarithms, exp sums to 1.
using GenreLogProbabilities = std::array<float, kMostGenres + 1>;

/// A beat as announced: fixed, never revised.
struct BeatEvent {
    StreamTime time{};        ///< when it sounds in the input (delays of the analysis taken off)
    int bar_position = 0;     ///< 1..beats_per_bar; 0: the bar is not known
    float confidence = 0.0F;  ///< [0, 1]
};

/// What the analyzer knows at one hop (10 ms): the only thing that passes from audio to motion.
/// States come in order, one for every hop, none left out.
struct MusicState {
    HopIndex hop = 0;        ///< sequence number; this state is about time_of_hop(hop)
    StreamTime time{};       ///< == time_of_hop(hop)
    StreamTime audio_end{};  ///< end of the audio that was used (>= time): causality in figures
    BeatGrid grid;

    bool has_beat = false;  ///< `beat` was announced since the last hop
    BeatEvent beat;
    bool has_predicted = false;  ///< `predicted` was committed: a beat about 100 ms ahead
    StreamTime predicted{};

    GenreLogProbabilities genre_log_probability{};
    std::uint8_t genre_class = 0;   ///< the decision, with hysteresis
    DanceId genre = DanceId::none;  ///< the same in the program's list; none: no dance, or unknown

    float loudness_lufs = -120.0F;  ///< momentary (400 ms, EBU R 128), >= -120
    float level_dbfs = -120.0F;     ///< rms of this hop, >= -120
    float onset_strength = 0.0F;    ///< [0, inf), all bands; 0 in silence
    bool is_silent = true;
    bool is_discontinuity = false;  ///< samples were lost before this hop; grid was re-anchored
};
static_assert(std::is_trivially_copyable_v<MusicState>);

}  // namespace raks
