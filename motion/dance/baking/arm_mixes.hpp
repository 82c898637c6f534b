#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <span>

#include "motion/dance/baking/figure_passage.hpp"

namespace raks::motion {

/// Ways to dance each figure.
inline constexpr std::size_t kWays = 8;

/// Which two passages of a figure have arms that can be mixed: [a][b].
using ArmMixes = std::array<std::bitset<kWays>, kWays>;

/// Those whose arms are never so far apart that the other way round would soon be the shorter one
/// (120 degrees of any bone). Their rotations' signs must agree (take_signs_of). `passages`: at
/// most kWays, of a figure so many beats long. Threads: workers. Real-time: no.
[[nodiscard]] ArmMixes arm_mixes(std::span<const FigurePassage> passages, int beats);

}  // namespace raks::motion
