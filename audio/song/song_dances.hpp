#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/music_state.hpp"

namespace raks::audio {

/// A part of a song that is music for one class of the genre model.
struct SongSection {
    std::size_t first_hop = 0;     ///< the section goes on to the next one, or to the end
    std::uint8_t genre_class = 0;  ///< of the model
};

/// The classes of a song's sections by the evidence of all of it: the most likely path over the
/// hops' probabilities, in which another class costs as much as some 20 s of clear evidence, so
/// that a song keeps its dance unless it truly changes. `states`: of the whole song, with
/// genre_log_probability as the stream had it; `classes`: of the model, its "none" included;
/// `window_seconds`: on which the probabilities were computed. One section at least, unless there
/// are no states. Threads: any. Real-time: no.
[[nodiscard]] std::vector<SongSection> find_sections(std::span<const MusicState> states,
                                                     std::size_t classes,
                                                     double window_seconds);

}  // namespace raks::audio
