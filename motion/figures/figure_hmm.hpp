// Figure HMM: between a figure's parts and the HMMs of models/.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

inline constexpr std::array<std::string_view, 2> kSideNames = {"left", "right"};  ///< by Side

/// The part's HMM: Gaussian emissions around the states' means, with the covariance or covariances
/// of its kind. For scoring, classification and reports (models::HmmScorer). Threads: any.
/// Real-time: no.
[[nodiscard]] models::GaussianHmm hmm_of(const PartModel& part);

/// Copies initial, transition and exit probabilities, means, covariances and their kind from an HMM
/// to the part. `tied`: D x D, the covariance of all states about their own means.
void take_hmm(const models::GaussianHmm& hmm, const Eigen::MatrixXd& tied, PartModel& part);

/// The same kind of covariance as models/ names it.
[[nodiscard]] models::CovarianceType covariance_type_of(CovarianceKind kind) noexcept;

/// Rows as a matrix; all rows must be as long as the first.
[[nodiscard]] Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows);

/// Rows first .. first + count - 1 of a track as observations: count x columns.
[[nodiscard]] models::Frames frames_of(const FeatureTrack& track,
                                       std::size_t first,
                                       std::size_t count);

// State timing: when a figure's states are danced: counts against states, and how long each lasts
// (Ofli 2008, section 4.1).

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
