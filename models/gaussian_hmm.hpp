#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Hidden Markov models with Gaussian emissions, for audio (genre) and motion (dance figures).
/// Notation of Rabiner 1989: N states, T frames, D features, K mixture components; natural
/// logarithms.
namespace raks::models {

/// A sequence, T x D: one row a frame, row-major.
using Frames = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Shape of the emissions' covariances: variances alone, a full matrix for each state, one matrix
/// for all states, or one variance for each state.
enum class CovarianceType : std::uint8_t { diagonal, full, tied, spherical };
/// By CovarianceType.
inline constexpr std::string_view kCovarianceNames[] = {"diagonal", "full", "tied", "spherical"};

/// A Gaussian hidden Markov model as it is trained and stored. HmmScorer evaluates it.
struct GaussianHmm {
    Eigen::VectorXd initial;     ///< N, sums to 1
    Eigen::MatrixXd transition;  ///< N x N; a row and its exit sum to 1
    /// N: probability that the sequence ends after a state. Empty: sequences may end anywhere at no
    /// cost, and the rows of `transition` alone sum to 1.
    Eigen::VectorXd exit;

    /// Component k of state n is row n K + k.
    Eigen::MatrixXd means;  ///< N K x D
    /// N x K mixture weights, rows sum to 1. K is 1 except for CovarianceType::diagonal.
    Eigen::MatrixXd weights;

    CovarianceType covariance_type = CovarianceType::diagonal;  ///< of all states
    /// diagonal: N K of D x 1 variances; full: N of D x D; tied: one D x D; spherical: N of 1 x 1.
    std::vector<Eigen::MatrixXd> covariances;

    [[nodiscard]] Eigen::Index states() const noexcept { return initial.size(); }    ///< N
    [[nodiscard]] Eigen::Index mixtures() const noexcept { return weights.cols(); }  ///< K
    [[nodiscard]] Eigen::Index dimension() const noexcept { return means.cols(); }   ///< D
};

/// How many covariances a model of a type has, and the shape of each.
struct CovarianceShape {
    Eigen::Index count = 0;  ///< matrices in GaussianHmm::covariances
    Eigen::Index rows = 0;   ///< of each
    Eigen::Index cols = 0;   ///< of each
};
/// For N `states`, K `mixtures` and D = `dimension`; see GaussianHmm::covariances. Real-time: yes.
[[nodiscard]] CovarianceShape covariance_shape(CovarianceType type,
                                               Eigen::Index states,
                                               Eigen::Index mixtures,
                                               Eigen::Index dimension) noexcept;

/// Checks that dimensions agree, numbers are finite, rows sum to 1 (within 1e-6), variances are > 0
/// and matrices positive definite. The error names the first wrong field: `transition[2] sums to
/// 0.9, must be 1`.
[[nodiscard]] Expected<void> validate(const GaussianHmm& model);

/// Start of a left-to-right model that is entered at state 0 and left after the last: each state is
/// left with probability 1 / `mean_duration` (frames, >= 1) for the next one. Emissions are
/// standard normal, to be replaced by training.
[[nodiscard]] GaussianHmm left_to_right(Eigen::Index states,
                                        Eigen::Index dimension,
                                        CovarianceType type,
                                        double mean_duration);

/// True when `matrix` is symmetric (within 1e-9 of its largest entry) and has a Cholesky factor.
[[nodiscard]] bool is_positive_definite(const Eigen::MatrixXd& matrix);

}  // namespace raks::models
