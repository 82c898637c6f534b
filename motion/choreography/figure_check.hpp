// Figure check: what is wrong with a written figure, found without making poses or in its poses.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motion/choreography/authored_dance.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

// Figure check: contradictions that can be found without making poses.

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

// Motion check: what a body cannot do of a written figure.

/// What a body cannot do of a figure at the dance's slowest, written and fastest tempo, without
/// noise: feet more than 2 cm out of the leg's reach, joints beyond their limits
/// (worst_joint), hands and forearms more than kMostHandDepth inside trunk, legs or head
/// (figure_measures.hpp, motion/skeleton/body_capsules.hpp). One line for the worst of each kind;
/// empty: none: `belly.toml: line 12: figure "drop": beat 3: left foot cannot be reached: 4 cm too
/// far; bring it nearer or bend the carrying knee more`. Threads: any. Real-time: no (some 10 ms).
[[nodiscard]] std::vector<std::string> faults_in_motion(const AuthoredDance& dance,
                                                        const AuthoredFigure& figure,
                                                        const Skeleton& skeleton);

}  // namespace raks::motion
