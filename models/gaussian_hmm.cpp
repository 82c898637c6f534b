#include "models/gaussian_hmm.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <string>

namespace raks::models {
namespace {

constexpr double kSumTolerance = 1e-6;  // of rows that must sum to 1
// Their inverses and logarithms stay far from the ends of what a double holds.
constexpr double kLeastVariance = 1e-30;
constexpr double kLargestVariance = 1e30;

// The error names the matrix and both sizes.
Expected<void> check_shape(std::string_view name,
                           Eigen::Index rows,
                           Eigen::Index cols,
                           const CovarianceShape& wanted) {
    if (rows != wanted.rows || cols != wanted.cols) {
        return fail(fmt::format(
            "{} is {} x {}, must be {} x {}", name, rows, cols, wanted.rows, wanted.cols));
    }
    return {};
}

/// Checks that all entries are probabilities and sum to 1 together with `rest` (the exit).
Expected<void> check_chances(const std::string& name, const Eigen::VectorXd& row, double rest) {
    for (Eigen::Index i = 0; i < row.size(); ++i) {
        if (!(row[i] >= 0.0 && row[i] <= 1.0 + kSumTolerance)) {
            return fail(fmt::format("{}[{}] is {}, must lie in [0, 1]", name, i, row[i]));
        }
    }
    const double sum = row.sum() + rest;
    if (std::abs(sum - 1.0) > kSumTolerance) {
        return fail(fmt::format(
            "{} sums to {:.6g}{}, must be 1", name, sum, rest > 0.0 ? " with its exit" : ""));
    }
    return {};
}

// Start, transitions and exits. Sizes come first, because the rows are indexed by them.
Expected<void> check_topology(const GaussianHmm& model) {
    const Eigen::Index n = model.states();
    if (n < 1) {
        return fail("initial is empty, must have one entry per state");
    }
    if (auto ok = check_chances("initial", model.initial, 0.0); !ok) {
        return ok;
    }
    if (auto ok =
            check_shape("transition", model.transition.rows(), model.transition.cols(), {0, n, n});
        !ok) {
        return ok;
    }
    if (model.exit.size() != 0 && model.exit.size() != n) {
        return fail(fmt::format("exit has {} entries, must have {} or none", model.exit.size(), n));
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const double exit = model.exit.size() == 0 ? 0.0 : model.exit[i];
        if (!(exit >= 0.0 && exit <= 1.0 + kSumTolerance)) {
            return fail(fmt::format("exit[{}] is {}, must lie in [0, 1]", i, exit));
        }
        if (auto ok = check_chances(
                fmt::format("transition[{}]", i), model.transition.row(i).transpose(), exit);
            !ok) {
            return ok;
        }
    }
    return {};
}

// One covariance whose shape is right already.
Expected<void> check_covariance(std::string_view name,
                                CovarianceType type,
                                const Eigen::MatrixXd& covariance) {
    if (!covariance.allFinite()) {
        return fail(fmt::format("{} has an entry that is not a finite number", name));
    }
    if (type == CovarianceType::full || type == CovarianceType::tied) {
        if (!is_positive_definite(covariance)) {
            return fail(fmt::format("{} is not positive definite (or not symmetric)", name));
        }
        return {};
    }
    // Variances: D of them, or one. The negated comparison also catches NaN.
    for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
        if (!(covariance(i, 0) >= kLeastVariance && covariance(i, 0) <= kLargestVariance)) {
            return fail(fmt::format("{}[{}] is {}, must lie in [{}, {}]",
                                    name,
                                    i,
                                    covariance(i, 0),
                                    kLeastVariance,
                                    kLargestVariance));
        }
    }
    return {};
}

// Weights, means and covariances, in the order of the file's fields.
Expected<void> check_emissions(const GaussianHmm& model) {
    const Eigen::Index n = model.states();
    const Eigen::Index k = model.mixtures();
    const Eigen::Index d = model.dimension();
    // Only diagonal models have mixtures: HmmScorer and the trainer rely on K = 1 otherwise.
    if (k < 1 || (k > 1 && model.covariance_type != CovarianceType::diagonal)) {
        return fail(fmt::format("weights has {} columns, must have {}",
                                k,
                                k < 1 ? "one or more" : "1 (mixtures are for diagonal only)"));
    }
    if (auto ok = check_shape("weights", model.weights.rows(), k, {0, n, k}); !ok) {
        return ok;
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        if (auto ok =
                check_chances(fmt::format("weights[{}]", i), model.weights.row(i).transpose(), 0.0);
            !ok) {
            return ok;
        }
    }
    if (d < 1) {
        return fail("means have no columns, must have one per feature");
    }
    if (auto ok = check_shape("means", model.means.rows(), d, {0, n * k, d}); !ok) {
        return ok;
    }
    if (!model.means.allFinite()) {
        return fail("means have an entry that is not a finite number");
    }
    // The type decides how many covariances there are and how large they are.
    const CovarianceShape shape = covariance_shape(model.covariance_type, n, k, d);
    if (static_cast<Eigen::Index>(model.covariances.size()) != shape.count) {
        return fail(fmt::format(
            "covariances has {} entries, must have {}", model.covariances.size(), shape.count));
    }
    for (std::size_t i = 0; i < model.covariances.size(); ++i) {
        const std::string name = fmt::format("covariances[{}]", i);
        const Eigen::MatrixXd& covariance = model.covariances[i];
        if (auto ok = check_shape(name, covariance.rows(), covariance.cols(), shape); !ok) {
            return ok;
        }
        if (auto ok = check_covariance(name, model.covariance_type, covariance); !ok) {
            return ok;
        }
    }
    return {};
}

}  // namespace

CovarianceShape covariance_shape(CovarianceType type,
                                 Eigen::Index states,
                                 Eigen::Index mixtures,
                                 Eigen::Index dimension) noexcept {
    switch (type) {
        case CovarianceType::diagonal:
            return {states * mixtures, dimension, 1};
        case CovarianceType::full:
            return {states, dimension, dimension};
        case CovarianceType::tied:
            return {1, dimension, dimension};
        case CovarianceType::spherical:
            return {states, 1, 1};
    }
    return {};
}

bool is_positive_definite(const Eigen::MatrixXd& matrix) {
    if (matrix.rows() != matrix.cols() || !matrix.allFinite()) {
        return false;
    }
    // Relative to the largest entry, because rounding grows with it.
    const double largest = matrix.size() == 0 ? 0.0 : matrix.cwiseAbs().maxCoeff();
    if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > 1e-9 * largest) {
        return false;
    }
    // A Cholesky factor exists exactly for positive definite matrices.
    return Eigen::LLT<Eigen::MatrixXd>(matrix).info() == Eigen::Success;
}

Expected<void> validate(const GaussianHmm& model) {
    if (auto ok = check_topology(model); !ok) {
        return ok;
    }
    return check_emissions(model);
}

GaussianHmm left_to_right(Eigen::Index states,
                          Eigen::Index dimension,
                          CovarianceType type,
                          double mean_duration) {
    GaussianHmm model;
    model.initial = Eigen::VectorXd::Zero(states);
    model.initial[0] = 1.0;
    model.transition = Eigen::MatrixXd::Zero(states, states);
    model.exit = Eigen::VectorXd::Zero(states);
    // Staying so long on average means leaving with the reciprocal chance at each frame.
    const double leave = 1.0 / std::max(mean_duration, 1.0);
    for (Eigen::Index i = 0; i < states; ++i) {
        model.transition(i, i) = 1.0 - leave;
        if (i + 1 < states) {
            model.transition(i, i + 1) = leave;
        } else {
            model.exit[i] = leave;
        }
    }
    model.means = Eigen::MatrixXd::Zero(states, dimension);
    model.weights = Eigen::MatrixXd::Ones(states, 1);
    model.covariance_type = type;
    const CovarianceShape shape = covariance_shape(type, states, 1, dimension);
    // Identity matrices, or variances of 1, in the shape that the type wants.
    const bool is_matrix = type == CovarianceType::full || type == CovarianceType::tied;
    const Eigen::MatrixXd unit = is_matrix
                                     ? Eigen::MatrixXd::Identity(shape.rows, shape.cols).eval()
                                     : Eigen::MatrixXd::Ones(shape.rows, shape.cols).eval();
    model.covariances.assign(static_cast<std::size_t>(shape.count), unit);
    return model;
}

}  // namespace raks::models
