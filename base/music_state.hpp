#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "base/beat_grid.hpp"
#include "base/time.hpp"

namespace raks {

/// The dances that music is sorted into. The order is that of every array over genres.
enum class Genre : std::uint8_t { salsa, belly, house, hiphop, rock, waltz, unknown };
inline constexpr int kGenreCount = 7;
inline constexpr std::array<std::string_view, kGenreCount> kGenreNames = {
    "salsa", "belly", "house", "hiphop", "rock", "waltz", "unknown"};
[[nodiscard]] constexpr std::string_view name_of(Genre genre) noexcept {
    return kGenreNames[static_cast<std::size_t>(genre)];
}

/// A beat as announced: fixed, never revised.
struct BeatEvent {
    StreamTime time{};        ///< when it sounds in the input (delays of the analysis taken off)
    int bar_position = 0;     ///< 1..beats_per_bar; 0: the bar is not known
    float confidence = 0.0F;  ///< [0, 1]
};

/// What the analyzer knows at one hop (10 ms): the only thing that passes from audio to motion.
/// States come in order, one for every hop, none left out.
struct MusicState {
    HopIndex hop = 0;          ///< sequence number; this state is about time_of_hop(hop)
    StreamTime time{};         ///< == time_of_hop(hop)
    StreamTime heard_until{};  ///< end of the audio that was used (>= time): causality in figures
    BeatGrid grid;

    bool has_beat = false;  ///< `beat` was announced since the last hop
    BeatEvent beat;
    bool has_predicted = false;  ///< `predicted` was committed: a beat about 100 ms ahead
    StreamTime predicted{};

    std::array<float, kGenreCount> genre_log_probability{};  ///< natural log, exp sums to 1
    Genre genre = Genre::unknown;                            ///< the decision, with hysteresis

    float loudness_lufs = -120.0F;  ///< momentary (400 ms, EBU R 128), >= -120
    float level_dbfs = -120.0F;     ///< rms of this hop, >= -120
    float onset_strength = 0.0F;    ///< [0, inf), all bands; 0 in silence
    bool is_silent = true;
    bool is_discontinuity = false;  ///< samples were lost before this hop; grid was re-anchored
};
static_assert(std::is_trivially_copyable_v<MusicState>);

}  // namespace raks
