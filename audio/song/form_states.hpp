#pragma once

#include <vector>

#include "audio/song/song_beats.hpp"
#include "audio/song/song_recording.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// Writes what a song does into its states: energy, part, and each event and accent at the hop at
/// which it sounds (a second event of one hop at the next hop), with the two events that come in
/// Foresight::events, the bar that sounds and what it repeats (song_bars.hpp). `end` is at the last
/// onset; what rings after it is still of its part. `states`: one for each of song.sounds, with
/// grid and foresight already written. Threads: any. Real-time: no.
void write_form(const SongRecording& song,
                const std::vector<SongBeat>& beats,
                std::vector<MusicState>& states);

}  // namespace raks::audio
