#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/label_tables.hpp"

/// The grid of beats of a take: what `raks train take` learns from, as it is proposed, looked at
/// and set right.
namespace raks::motion {

/// One beat of a take.
struct GridBeat {
    double time = 0.0;    ///< seconds from the clip's first frame
    int half = 1;         ///< of the bar, 1 or 2
    bool is_used = true;  ///< the beat that begins here may be danced

    friend bool operator==(const GridBeat&, const GridBeat&) = default;
};

/// All beats of a take, rising.
struct TakeGrid {
    std::string take;  ///< the clip's file name without extension
    std::vector<GridBeat> beats;

    friend bool operator==(const TakeGrid&, const TakeGrid&) = default;
};

/// The rows of a table by take, in the order in which takes first come.
[[nodiscard]] std::vector<TakeGrid> grids_of(std::span<const TakeBeat> beats);

/// Grids as a table that parse_take_beats reads; what is read is the same. Each line of `remarks`
/// becomes a line that readers skip.
[[nodiscard]] std::string grids_text(std::span<const TakeGrid> grids,
                                     std::span<const std::string> remarks = {});

/// Whether a grid lies within its clip of so many seconds. Errors: the first beat behind its end,
/// with take, place and length.
[[nodiscard]] Expected<void> check_grid(const TakeGrid& grid, double seconds);

}  // namespace raks::motion
