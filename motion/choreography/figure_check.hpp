// Figure check: contradictions that can be found without making poses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// A contradiction in a figure, and where it is.
struct FigureFault {
    std::size_t line = 0;  ///< in the file
    std::string message;   ///< "beat 3: ..."
};

/// The first fault of a figure; none: it is sound. Checked in this order: keys outside the figure;
/// the sum of a control's tracks beyond its limits; steps of one foot that leave the floor long
/// before the step before has landed, also over the end of the figure into its repeat; feet that
/// land on one another. Threads: any. Real-time: no.
[[nodiscard]] std::optional<FigureFault> first_fault(const AuthoredFigure& figure);

}  // namespace raks::motion
