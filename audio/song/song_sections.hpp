#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/form/hop_sound.hpp"
#include "audio/song/song_beats.hpp"
#include "audio/song/song_pauses.hpp"

namespace raks::audio {

/// A part of a song without its rhythm section: hops [first, end).
struct SongBreakdown {
    std::size_t first = 0;     ///< hop of the beat at which the rhythm section leaves
    std::size_t build_up = 0;  ///< hop of the beat from which it rises; `end`: it does not
    std::size_t end = 0;       ///< hop of the beat at which the rhythm section is back
    bool drops = false;        ///< everything comes in at the end
};

/// The breakdowns of a song, ascending, by the rules of a stream (section_rules.hpp) on the bars
/// around each beat; they begin and end on beats. What is quiet in `pauses` is left out of the
/// comparison. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongBreakdown> find_breakdowns(std::span<const HopSound> sounds,
                                                         const std::vector<SongPause>& pauses,
                                                         const std::vector<SongBeat>& beats);

}  // namespace raks::audio
