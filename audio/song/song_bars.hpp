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
/// that its onset lies within), in dB against the band's mean over the song; what is far below that
/// mean is of no matter. `states`: of the whole song, with grid, foresight and parts written.
/// Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongBar> bars_of(const SongRecording& song,
                                           const std::vector<SongBeat>& beats,
                                           std::span<const MusicState> states);

/// How unlike two bars sound, for find_repeats(): the root of the mean square of the differences of
/// `sound`, in units of the difference up to which bars count as alike. Infinite where they have
/// not as many beats, or the music does not do the same in them.
[[nodiscard]] float distance_of(const SongBar& a, const SongBar& b) noexcept;

/// Writes the bar that sounds and what it and the next ones repeat into the states' foresight.
/// Threads: any. Real-time: no.
void write_bars(const SongRecording& song,
                const std::vector<SongBeat>& beats,
                std::vector<MusicState>& states);

}  // namespace raks::audio
