// Figure sides: how a figure is danced left for right.
#pragma once

#include <optional>

#include "motion/dance/baking/figure_passage.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What must be known of a figure to dance it as its mirror image.
struct FigureSides {
    bool can_mirror = false;  ///< it may be
    /// The foot that its first step is danced with, or is free as it begins; none: both stand, or
    /// both fly. Mirrored it is the other one.
    std::optional<Side> leads;
    /// LibraryFigure::place of the mirror image
    FloorMove mirrored_place;
};

/// The stance that a figure begins from, in the frame of its start: midpoint of both balls, mean
/// heading of the feet. Threads: any. Real-time: no.
[[nodiscard]] FloorMove stance_before(const FigurePassage& passage, const Skeleton& skeleton);

/// Looks at one way to dance a figure. `stance`: where all figures of the dance begin, in its
/// frame. Whether it may be mirrored is not known here. Threads: any. Real-time: no.
[[nodiscard]] FigureSides sides_of(const FigurePassage& passage,
                                   const FloorMove& stance,
                                   const Skeleton& skeleton);

}  // namespace raks::motion
