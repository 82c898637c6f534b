#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "audio/form/hop_sound.hpp"

namespace raks::audio {

/// A stretch of a song in which nothing sounds: hops [first, end).
struct SongPause {
    std::size_t first = 0;  ///< first hop that is quiet
    std::size_t end = 0;    ///< first hop that sounds again, or the end of the song
    [[nodiscard]] std::size_t hops() const noexcept { return end - first; }  ///< how long
};

/// The stops of a song, ascending, with the silence before its first and after its last sound: at
/// least `least_hops` below the level of the seconds around, and not one of many alike, as the gaps
/// of staccato music are. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongPause> find_pauses(std::span<const HopSound> sounds,
                                                 std::size_t least_hops);

}  // namespace raks::audio
