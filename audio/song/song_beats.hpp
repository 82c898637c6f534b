#pragma once

#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "audio/song/bar_path.hpp"
#include "audio/song/song_recording.hpp"
#include "base/beat_grid.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// A beat of a song, as known from all of it.
struct SongBeat {
    StreamTime time{};        ///< when it sounds
    BarPlace place;           ///< in its bar
    float confidence = 0.0F;  ///< [0, 1]: whether there is a beat in the music at all
    bool is_restart = false;  ///< does not follow the beat before at a steady tempo
};

/// All beats of a song: the best path of the pointer, then the best path of the bars. Beats go on
/// through parts without any; there the confidence is 0. `bars`: the network for bars, or null.
/// `told_bpm`: BeatPointerConfig::told_bpm. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongBeat> track_song(const SongRecording& song,
                                               std::shared_ptr<const BarNetwork> bars,
                                               double told_bpm);

/// The grid at a moment: a line through the beats around it; before the first and after the last it
/// goes on at their tempo. Beats are numbered from 0. Needs two beats.
[[nodiscard]] BeatGrid grid_at(const std::vector<SongBeat>& beats, StreamTime time);

}  // namespace raks::audio
