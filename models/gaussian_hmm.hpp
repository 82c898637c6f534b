#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Hidden Markov models with Gaussian emissions, for audio (genre) and motion (dance figures).
/// Notation of Rabiner 1989: N states, T frames, D features; natural logarithms.
namespace raks::models {

/// T x D: one row a frame.
using Frames = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class CovarianceType : std::uint8_t { diagonal, full, tied, spherical };
inline constexpr std::string_view kCovarianceNames[] = {"diagonal", "full", "tied", "spherical"};

/// A Gaussian hidden Markov model as it is learnt and stored. Evaluate it with HmmScorer.
struct GaussianHmm {
    Eigen::VectorXd initial;     ///< N, sums to 1
    Eigen::MatrixXd transition;  ///< N x N; a row and its exit sum to 1
    /// N: chance that the sequence ends after a state. Empty: sequences may end anywhere, at no
    /// price, and the rows alone sum to 1.
    Eigen::VectorXd exit;

    /// Component k of state n is row n K + k.
    Eigen::MatrixXd means;  ///< N K x D
    /// N x K mixture weights, rows sum to 1. K = 1 but for CovarianceType::diagonal.
    Eigen::MatrixXd weights;

    CovarianceType covariance_type = CovarianceType::diagonal;
    /// diagonal: N K of D x 1 variances; full: N of D x D; tied: one D x D; spherical: N of 1 x 1.
    std::vector<Eigen::MatrixXd> covariances;

    [[nodiscard]] Eigen::Index states() const noexcept { return initial.size(); }
    [[nodiscard]] Eigen::Index mixtures() const noexcept { return weights.cols(); }
    [[nodiscard]] Eigen::Index dimension() const noexcept { return means.cols(); }
};

/// How many covariances a model of this type holds, and the shape of each.
struct CovarianceShape {
    Eigen::Index count = 0;
    Eigen::Index rows = 0;
    Eigen::Index cols = 0;
};
[[nodiscard]] CovarianceShape covariance_shape(CovarianceType type,
                                               Eigen::Index states,
                                               Eigen::Index mixtures,
                                               Eigen::Index dimension) noexcept;

/// Dimensions agree, numbers are finite, rows sum to 1 (within 1e-6), variances are > 0, matrices
/// positive definite. The error names the first wrong field: `transition[2] sums to 0.9, must be
/// 1`.
[[nodiscard]] Expected<void> validate(const GaussianHmm& model);

/// Start of a left-to-right model with entry at state 0 and exit after the last: each state is
/// left with chance 1 / `mean_duration` (frames, >= 1), for the next one. Emissions are standard
/// normal, to be replaced.
[[nodiscard]] GaussianHmm left_to_right(Eigen::Index states,
                                        Eigen::Index dimension,
                                        CovarianceType type,
                                        double mean_duration);

/// True when `matrix` is symmetric (within 1e-9 of its largest entry) and has a Cholesky factor.
[[nodiscard]] bool is_positive_definite(const Eigen::MatrixXd& matrix);

}  // namespace raks::models
