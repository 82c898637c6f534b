#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/song/song_beats.hpp"
#include "audio/song/song_recording.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// A bar of a song, and how it sounds.
struct SongBar {
    StreamTime time{};                    ///< its downbeat
    int beats = 4;                        ///< how many it has
    MusicPart part = MusicPart::stopped;  ///< what the music does in most of it
    std::vector<float> sound;             ///< 2 x beats x SongRecording::kMelBands, dB
};

/// The bars of a song from Foresight::begins to the last beat that can be danced to, in order.
/// `sound` is the mean magnitude of each mel band over each half beat (all 20 % of it early, so
/// that its onset lies within), in dB against the band's mean over the song; what is 10 dB below
/// that mean and fainter is of no matter. `states`: of the whole song, with grid, foresight and
/// parts written. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongBar> bars_of(const SongRecording& song,
                                           const std::vector<SongBeat>& beats,
                                           std::span<const MusicState> states);

/// How two bars differ.
struct BarDifference {
    bool is_known = false;  ///< false: not as many beats, or the music does not do the same
    float level = 0.0F;     ///< mean of the differences of `sound`, as a size; dB
    float shape = 0.0F;     ///< their standard deviation; dB
};
[[nodiscard]] BarDifference difference_of(const SongBar& a, const SongBar& b) noexcept;

/// Up to which difference of shape two bars of a song sound alike, in dB: .6 of the median over its
/// pairs of bars, of which 2,000 are drawn; 1.2 to 3. Whoever plays by hand plays a part otherwise
/// the next time, by 2 to 3 dB where two bars of a song are mostly 3.5 to 5 apart; a machine by 0.2
/// to 1, of 1.7 to 2.
[[nodiscard]] float alike_shape(std::span<const SongBar> bars);

/// For find_repeats(): the greater of shape over alike_shape() and level over 1.5 dB.
[[nodiscard]] float distance_of(const SongBar& a, const SongBar& b, float alike_shape) noexcept;

/// Writes the bar that sounds and what it and the next ones repeat into the states' foresight.
/// Threads: any. Real-time: no.
void write_bars(const SongRecording& song,
                const std::vector<SongBeat>& beats,
                std::vector<MusicState>& states);

}  // namespace raks::audio
