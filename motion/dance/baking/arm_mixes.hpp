// Arm mixes: which passages' arms may be averaged.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <span>

#include "motion/dance/baking/figure_passage.hpp"

namespace raks::motion {

/// Number of passages (ways to dance it) of each figure.
inline constexpr std::size_t kWays = 8;

/// Whether the arms of passages a and b of a figure can be mixed: [a][b].
using ArmMixes = std::array<std::bitset<kWays>, kWays>;

/// Two passages' arms can be mixed when no bone of theirs is ever 120 degrees or more apart; beyond
/// that the shorter way round would soon change. Their quaternions' signs must agree
/// (take_signs_of). `passages`: at most kWays, of a figure of `beats`. Threads: workers. Real-time:
/// no.
[[nodiscard]] ArmMixes arm_mixes(std::span<const FigurePassage> passages, int beats);

}  // namespace raks::motion
