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
#include "motion/figures/state_learning.hpp"

namespace raks::motion {

inline constexpr std::array<std::string_view, 2> kSideNames = {"left", "right"};  ///< by Side

/// The part's HMM: emissions around the states' means with the covariance, or covariances, of its
/// kind. For scoring, classification and reports (models::HmmScorer).
[[nodiscard]] models::GaussianHmm hmm_of(const PartModel& part);

/// Initial, transition, exit, state means and covariances of a model into the part, its kind of
/// covariance, too. `tied`: D x D, the covariance of all states about their own means.
void take_hmm(const models::GaussianHmm& hmm, const Eigen::MatrixXd& tied, PartModel& part);

/// A left-to-right HMM. Errors: no sequence of at least as many frames as states.
[[nodiscard]] Expected<models::TrainingResult> learn_states(const models::TrainingSet& set,
                                                            const StateLearning& learning);

/// The most likely states of every sequence, and the tied covariance about their means.
struct FollowedStates {
    std::vector<std::vector<std::size_t>> paths;  ///< Viterbi; of each sequence
    Eigen::MatrixXd tied;                         ///< D x D, with the floor on its diagonal
};
[[nodiscard]] Expected<FollowedStates> follow_states(const models::GaussianHmm& hmm,
                                                     const models::TrainingSet& set,
                                                     double covariance_floor);

[[nodiscard]] Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows);

/// Rows `first` to `first + count` of a track as frames of a sequence.
[[nodiscard]] models::Frames frames_of(const FeatureTrack& track,
                                       std::size_t first,
                                       std::size_t count);

}  // namespace raks::motion
