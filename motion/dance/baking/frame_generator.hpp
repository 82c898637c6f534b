#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/random.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

/// The paper's synthesis (Ofli 2008, section 5): states of the parts' HMMs paced by the beat, a
/// Gaussian draw from each, smoothed.
namespace raks::motion {

/// The state of every sample of a figure, by Part; all three advance by the same draws.
using CoupledPath = std::array<std::vector<std::size_t>, 3>;

/// States of one repeat. At sample t of count c a part in state i stays with a chance in proportion
/// to a(i, i) x occurrence(c, i) or goes on to the next state by a(i, i + 1) x occurrence(c, i +
/// 1): its HMM's transitions, weighted by the table of counts against states. Where both products
/// are zero and a later state occurs at the count (the part is late), it goes on at once. The parts
/// share one draw a sample, so that legs, arms and torso run late or early together. `random`:
/// numbers 1 to T - 1 are used. (The table is what couples the parts to the beat in the paper; the
/// shared draw is an addition.) Threads: workers. Real-time: no.
[[nodiscard]] CoupledPath coupled_path(const FigureModel& model, const CounterRandom& random);

/// One repeat: a draw from the state's Gaussian at every sample (one by CovarianceKind), then a
/// median and a Gaussian filter over the phase, closed: 9 frames and a deviation of 3 frames of 60
/// a second at the learnt tempo. Each feature on its own, as in the paper. `repeat` tells repeats
/// apart: same number, same bits. Threads: workers. Real-time: no.
[[nodiscard]] FigureTracks drawn_tracks(const FigureModel& model,
                                        std::uint64_t figure,
                                        std::uint64_t repeat);

}  // namespace raks::motion
