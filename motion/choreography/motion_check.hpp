// Motion check: what a body cannot do of a written figure.
#pragma once

#include <string>
#include <vector>

#include "motion/choreography/authored_dance.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// What a body cannot do of a figure at the dance's slowest, written and fastest tempo, without
/// noise: feet more than 2 cm out of the leg's reach, joints beyond their limits
/// (joint_limits.hpp), hands and forearms more than kMostHandDepth inside trunk, legs or head
/// (figure_measures.hpp, motion/skeleton/body_capsules.hpp). One line for the worst of each kind;
/// empty: none: `belly.toml: line 12: figure "drop": beat 3: left foot cannot be reached: 4 cm too
/// far; bring it nearer or bend the carrying knee more`. Threads: any. Real-time: no (some 10 ms).
[[nodiscard]] std::vector<std::string> faults_in_motion(const AuthoredDance& dance,
                                                        const AuthoredFigure& figure,
                                                        const Skeleton& skeleton);

}  // namespace raks::motion
