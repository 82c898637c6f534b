#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/music_state.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// An event that a piece was made with.
struct TrueEvent {
    MusicEvent event;   ///< what happens, and when
    Nanos tolerance{};  ///< from its time, to either side, within which it counts as found
};

/// An event that an analysis told.
struct ToldEvent {
    MusicEvent event;   ///< what it told
    StreamTime told{};  ///< the hop at which it did
};

/// How well the events of one kind were found.
struct EventScore {
    std::size_t wanted = 0;       ///< in the pieces
    std::size_t found = 0;        ///< of these, within their tolerance
    std::size_t false_ones = 0;   ///< told where there was none
    std::vector<double> offsets;  ///< seconds of those found from the truth
    std::vector<double> delays;   ///< seconds from the truth to when they were told

    /// Share of those wanted that were found, 1 where there are none.
    [[nodiscard]] double recall() const noexcept;
    /// Share of those told that were right, 1 where there are none.
    [[nodiscard]] double precision() const noexcept;
};

/// By kind of MusicEvent, "none" included.
using FormScores = std::array<EventScore, kMusicEventNames.size()>;

/// What was wrong in one piece.
struct FormFaults {
    std::vector<MusicEvent> missed;      ///< true events that were not found
    std::vector<MusicEvent> false_ones;  ///< told where there was none
};

/// Adds the scores of one piece and returns its faults. Each told event matches one at most. No
/// fault are: the entry of a drop that comes out of a stop, and what is told of the sound that
/// rings after the end. `truth` ascends. Threads: any. Real-time: no.
FormFaults score_form(std::span<const TrueEvent> truth,
                      std::span<const ToldEvent> told,
                      FormScores& scores);

}  // namespace raks::audio
