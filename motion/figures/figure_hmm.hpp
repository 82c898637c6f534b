#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "models/gaussian_hmm.hpp"
#include "models/hmm_training.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

inline constexpr std::array<std::string_view, 2> kSideNames = {"left", "right"};  ///< by Side

/// The part's HMM: emissions around the states' means with the tied covariance. For scoring,
/// classification and reports (models::HmmScorer).
[[nodiscard]] models::GaussianHmm hmm_of(const PartModel& part);

/// Initial, transition, exit, state means and covariance of a tied model into the part.
void take_hmm(const models::GaussianHmm& hmm, PartModel& part);

/// A left-to-right HMM with a tied covariance: states on equal slices of the sequences, then
/// `iterations` of Baum-Welch. `covariance_floor`: FigureTrainingOptions.
[[nodiscard]] Expected<models::TrainingResult> learn_states(const models::TrainingSet& set,
                                                            int states,
                                                            int iterations,
                                                            double covariance_floor);

[[nodiscard]] Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows);

/// Rows `first` to `first + count` of a track as frames of a sequence.
[[nodiscard]] models::Frames frames_of(const FeatureTrack& track,
                                       std::size_t first,
                                       std::size_t count);

}  // namespace raks::motion
