// Figure HMM: between a figure's parts and the HMMs of models/.
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

}  // namespace raks::motion
