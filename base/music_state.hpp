#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "base/beat_grid.hpp"
#include "base/dance_list.hpp"
#include "base/time.hpp"

namespace raks {

/// Most genres of one genre model.
inline constexpr std::size_t kMostGenres = 16;
/// By class of the genre model: its genres, then none of them. Natural logarithms; their
/// exponentials sum to 1.
using GenreLogProbabilities = std::array<float, kMostGenres + 1>;

/// A beat as announced; it is never revised.
struct BeatEvent {
    StreamTime time{};  ///< when it sounds in the input, corrected for the delays of the analysis
    int bar_position = 0;     ///< 1..beats_per_bar; 0: the bar is not known
    float confidence = 0.0F;  ///< [0, 1]
};

/// What is known beyond a hop where the whole song was analysed before it sounds.
struct Foresight {
    bool is_known = false;  ///< false: the rest means nothing, only the past is known
    StreamTime begins{};    ///< the first downbeat that can be danced to
    StreamTime ends{};      ///< the last beat that can
    float energy =
        0.5F;  ///< [0, 1]: loudness of the next two bars or so; 0.5: as in the whole song
};

/// What the analyzer knows at one hop (10 ms): the only data that passes from audio to motion.
/// States come in order, one for every hop, without gaps.
struct MusicState {
    HopIndex hop = 0;   ///< sequence number; this state is about time_of_hop(hop)
    StreamTime time{};  ///< == time_of_hop(hop)
    /// End of the audio used so far (>= time); shows in plots that no future audio was used.
    StreamTime audio_end{};
    BeatGrid grid;  ///< tempo, beats and bars from here on

    bool has_beat = false;       ///< `beat` was announced since the last hop
    BeatEvent beat;              ///< valid while has_beat
    bool has_predicted = false;  ///< `predicted` was committed: a beat about 100 ms ahead
    StreamTime predicted{};      ///< its time; valid while has_predicted

    GenreLogProbabilities genre_log_probability{};  ///< over the model's classes
    std::uint8_t genre_class = 0;                   ///< the decided class, with hysteresis
    /// The dance of genre_class in the program's list; none: no dance, or unknown.
    DanceId genre = DanceId::none;

    float loudness_lufs = -120.0F;  ///< momentary (400 ms, EBU R 128), >= -120
    float level_dbfs = -120.0F;     ///< rms of this hop, >= -120
    float onset_strength = 0.0F;    ///< [0, inf), all bands; 0 in silence
    bool is_silent = true;          ///< no sound to analyse
    bool is_discontinuity = false;  ///< samples were lost before this hop; grid was re-anchored

    Foresight ahead;  ///< of a song that is known before it sounds
};
static_assert(std::is_trivially_copyable_v<MusicState>);

}  // namespace raks
