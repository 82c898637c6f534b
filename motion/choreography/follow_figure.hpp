// Follow figure: the follow's part of a written figure, made from the lead's.
#pragma once

#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// The figure as the follow dances it, in a frame of her own, which faces the lead's from
/// `couple.apart`. Opposite: she moves as one with the lead, as a closed frame does: each of his
/// steps is one of her other foot, to the place that is before it then, heel against ball; both
/// turn and lean to the same side of the room. Where the figure has follow_steps she takes those
/// instead (a turn takes her round him, which his steps do not tell). Mirror: his mirror image.
/// Threads: any. Real-time: no.
[[nodiscard]] AuthoredFigure follow_of(const AuthoredFigure& lead, const CoupleStyle& couple);

}  // namespace raks::motion
