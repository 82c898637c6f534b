#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// What contradicts itself in a figure, and where.
struct FigureFault {
    std::size_t line = 0;
    std::string message;  ///< "beat 3: ..."
};

/// Keys outside the figure; values beyond a control's limits (its tracks added up); steps of one
/// foot that land at one time or leave the floor before they have landed, also over the end of the
/// figure into its repeat; a foot that bears weight while it is off the floor together with the
/// other. Threads: any. Real-time: no.
[[nodiscard]] std::optional<FigureFault> first_fault(const AuthoredFigure& figure);

}  // namespace raks::motion
