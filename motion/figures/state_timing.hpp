#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "motion/figures/figure_model.hpp"

/// State timing: when a figure's states are danced: counts against states, and how long each lasts
/// (Ofli 2008, section 4.1).
namespace raks::motion {

/// By repeat and sample: the state on the Viterbi path.
using StatePaths = std::vector<std::vector<std::size_t>>;

/// The table PartModel::occurrence of these paths: beats x states, rows sum to 1. Every path must
/// have beats x samples_per_beat states. Threads: any. Real-time: no.
[[nodiscard]] std::vector<std::vector<double>> count_occurrence(const StatePaths& paths,
                                                                int beats,
                                                                int samples_per_beat,
                                                                std::size_t states);

/// By state and repeat: how long the state lasts, in beats.
[[nodiscard]] std::vector<std::vector<double>> state_lengths(const StatePaths& paths,
                                                             int samples_per_beat,
                                                             std::size_t states);

/// Sets the part's occurrence and stays from paths.
void set_timing(const StatePaths& paths, int beats, int samples_per_beat, PartModel& part);

/// The same with every state on its slice of the phase, as the dancer plays them: for model files
/// that lack the table.
void set_sliced_timing(int beats, int samples_per_beat, PartModel& part);

}  // namespace raks::motion
