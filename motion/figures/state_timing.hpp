#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/figures/figure_model.hpp"

/// When a figure's states are danced: counts against states, and how long each lasts (Ofli 2008,
/// section 4.1).
namespace raks::motion {

/// Of each repeat, the state of each of its samples.
using StatePaths = std::vector<std::vector<std::size_t>>;

/// PartModel::occurrence of these paths: beats x states, rows sum to 1. Every path has
/// beats x samples_per_beat states.
[[nodiscard]] std::vector<std::vector<double>> count_occurrence(const StatePaths& paths,
                                                                int beats,
                                                                int samples_per_beat,
                                                                std::size_t states);

/// Of each state, its length in each repeat; beats.
[[nodiscard]] std::vector<std::vector<double>> state_lengths(const StatePaths& paths,
                                                             int samples_per_beat,
                                                             std::size_t states);

/// Sets the part's occurrence and stays.
void set_timing(const StatePaths& paths, int beats, int samples_per_beat, PartModel& part);

/// The same with every state on its slice of the phase, as the dancer has them: for models that
/// were learnt before the table was kept.
void set_sliced_timing(int beats, int samples_per_beat, PartModel& part);

}  // namespace raks::motion
