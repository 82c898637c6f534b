#pragma once

#include <span>
#include <vector>

#include "audio/form/hop_sound.hpp"
#include "audio/song/song_pauses.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// The energy at each hop of a song against the range of all of it: `now` of the half second and
/// `lately` of the 4 s around the hop, `longer` of the 30 s before it; 0 in the pauses. Threads:
/// any. Real-time: no.
[[nodiscard]] std::vector<MusicEnergy> measure_energy(std::span<const HopSound> sounds,
                                                      const std::vector<SongPause>& pauses);

}  // namespace raks::audio
