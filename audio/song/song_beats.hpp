#pragma once

#include <memory>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "audio/beat/network/confidence_model.hpp"
#include "audio/song/bar_path.hpp"
#include "audio/song/song_recording.hpp"
#include "base/beat_grid.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// A beat of a song, as known from all of it.
struct SongBeat {
    StreamTime time{};        ///< when it sounds
    BarPlace place;           ///< in its bar
    float confidence = 0.0F;  ///< [0, 1]: whether there is a beat in the music at all
    RivalTempo rival;         ///< the tempo that it may be instead
    int parts = 2;            ///< into which the music divides it, 2 or 3
    bool is_restart = false;  ///< does not follow the beat before at a steady tempo
};

/// All beats of a song: the best path of the pointer, then the best path of the bars. Beats go on
/// through parts without any; there the confidence is 0. `network`: for bars, for the
/// metre, and how sure beats are; null: none.
/// `told_bpm`: BeatPointerConfig::told_bpm. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongBeat> track_song(const SongRecording& song,
                                               const BeatNetwork* network,
                                               double told_bpm);

/// The grid at a moment: a line through the beats around it; before the first and after the last it
/// goes on at their tempo. Beats are numbered from 0. Needs two beats.
[[nodiscard]] BeatGrid grid_at(const std::vector<SongBeat>& beats, StreamTime time);

}  // namespace raks::audio
