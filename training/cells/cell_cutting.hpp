#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/cells/cell_arcs.hpp"
#include "training/cells/prepared_take.hpp"

namespace raks::motion {

/// What becomes of a beat of a table.
enum class BeatFate : std::uint8_t {
    danced,  ///< it is a cell
    unused,  ///< the table says so; and the last beat, which only ends the one before
    length,  ///< much shorter or longer than a beat of music that is danced to
    idle,    ///< most of it: TakePostures::is_idle
    home,    ///< most of it: TakePostures::is_home
    spread,  ///< most of it: TakePostures::is_spread
    leap,    ///< a frame of it: TakePostures::is_leap
    edge,    ///< the clip begins or ends beside it
    apart,   ///< no way leads from it to the other cells and back
    far,     ///< it leads to no rest, ending or great cell within some beats
};
inline constexpr std::size_t kBeatFates = 10;
/// For people, by BeatFate.
inline constexpr std::array<std::string_view, kBeatFates> kBeatFateNames = {
    "danced",
    "not used",
    "too short or too long",
    "idle",
    "in a robot's home pose",
    "with arms held spread",
    "with a leap of the capture",
    "at an end of the clip",
    "apart from the others",
    "far from a rest, an ending or the greatest"};

/// Rows [first, last) of a take's beats, all of them danced, which are learnt as one chain of
/// states. The chain has one more beat on either side, of the motion around what is danced.
struct TakeStretch {
    std::size_t first = 0;
    std::size_t last = 0;             ///< see above
    std::vector<double> beat_frames;  ///< of the chain's beats and its end: last - first + 3
};

/// A take cut into cells.
struct TakeCut {
    std::vector<BeatFate> fates;         ///< by beat of the table
    std::vector<TakeStretch> stretches;  ///< rising
    /// By stretch and beat. Cell::take is the stretch's index; Cell::beat counts from the chain's
    /// first beat.
    std::vector<CellSource> cells;
    /// Of the cells: landings, and how many of them are further than kFarLanding from a beat.
    std::size_t landings = 0;
    std::size_t far_landings = 0;  ///< see above
};

/// Seconds of a cell: 67 to 188 beats a minute.
inline constexpr double kShortestCell = 0.32;
inline constexpr double kLongestCell = 0.90;  ///< see above

/// Most beats of one chain: what a figure may have.
inline constexpr std::size_t kLongestStretch = 58;

/// Cuts a take at its beats. Errors: fewer than two beats; a beat beyond the end of the clip.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<TakeCut> cut_take(const PreparedTake& take,
                                         const std::vector<TakeBeat>& beats);

/// Frames of the clip in which a cell is danced. Threads: any. Real-time: no.
[[nodiscard]] std::vector<bool> danced_frames(const PreparedTake& take,
                                              const std::vector<TakeBeat>& beats,
                                              const TakeCut& cut);

}  // namespace raks::motion
