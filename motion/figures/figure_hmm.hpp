#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::motion {

inline constexpr std::array<std::string_view, 2> kSideNames = {"left", "right"};  ///< by Side

/// The part's HMM: emissions around the states' means with the covariance, or covariances, of its
/// kind. For scoring, classification and reports (models::HmmScorer).
[[nodiscard]] models::GaussianHmm hmm_of(const PartModel& part);

/// Initial, transition, exit, state means and covariances of a model into the part, its kind of
/// covariance, too. `tied`: D x D, the covariance of all states about their own means.
void take_hmm(const models::GaussianHmm& hmm, const Eigen::MatrixXd& tied, PartModel& part);

/// The type of covariance that the trainer of HMMs calls so.
[[nodiscard]] models::CovarianceType covariance_type_of(CovarianceKind kind) noexcept;

[[nodiscard]] Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows);

/// Rows `first` to `first + count` of a track as frames of a sequence.
[[nodiscard]] models::Frames frames_of(const FeatureTrack& track,
                                       std::size_t first,
                                       std::size_t count);

}  // namespace raks::motion
