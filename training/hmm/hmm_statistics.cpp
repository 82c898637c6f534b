#include "training/hmm/hmm_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace raks::models {
namespace {

// Types whose moments are D x D; the others need only the diagonal.
bool is_matrix_type(CovarianceType type) noexcept {
    return type == CovarianceType::full || type == CovarianceType::tied;
}

/// Frames [first, first + count) of a sequence.
struct Stretch {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
};

/// The stretch of frames in which a state may be: outside it all posteriors are too small to change
/// a sum over the frames in doubles. In a left-to-right model that spares most of the sequence.
Stretch occupied(const Frames& posteriors, Eigen::Index state) {
    constexpr double kLeastPosterior = 1e-18;  // a double has 16 digits
    Eigen::Index first = 0;
    Eigen::Index end = posteriors.rows();
    while (first < end && posteriors(first, state) < kLeastPosterior) {
        ++first;
    }
    while (end > first && posteriors(end - 1, state) < kLeastPosterior) {
        --end;
    }
    return {first, end - first};
}

/// gamma of each component of one state, T x K: the state's posterior times the component's share
/// of the state's density (Rabiner 1989, eq. 54).
Frames component_posteriors(const HmmScorer& scorer,
                            const Eigen::Ref<const Frames>& frames,
                            const Eigen::Ref<const Frames>& posteriors,
                            std::size_t state) {
    const Eigen::Index k = static_cast<Eigen::Index>(scorer.mixtures());
    Frames result(frames.rows(), k);
    std::vector<double> logs(scorer.mixtures());
    for (Eigen::Index t = 0; t < frames.rows(); ++t) {
        const double gamma = posteriors(t, static_cast<Eigen::Index>(state));
        // One component has the whole posterior; without a posterior there is nothing to share.
        if (k == 1 || gamma == 0.0) {
            result.row(t).setConstant(gamma);
            continue;
        }
        scorer.log_components({frames.row(t).data(), scorer.dimension()}, state, logs);
        const double total = log_sum(logs);
        for (Eigen::Index c = 0; c < k; ++c) {
            result(t, c) = gamma * std::exp(logs[static_cast<std::size_t>(c)] - total);
        }
    }
    return result;
}

/// A row of probabilities from counts; `row` stays as it is where nothing was counted. Zeros stay
/// zero because the E-step counts nothing there.
template <typename Row>
void set_chances(Row&& row, double& exit, const Eigen::VectorXd& counts, double exits) {
    const double total = counts.sum() + exits;
    if (total > 0.0) {
        row = counts.transpose() / total;
        exit = exits / total;
    }
}

// Initial, transition and exit probabilities, and mixture weights, from their counts.
void set_topology(GaussianHmm& next, const HmmStatistics& statistics) {
    if (const double total = statistics.initial.sum(); total > 0.0) {
        next.initial = statistics.initial / total;
    }
    // A row and its exit share one sum: they sum to 1 together.
    for (Eigen::Index i = 0; i < next.states(); ++i) {
        double unused = 0.0;
        const bool has_exit = next.exit.size() != 0;
        set_chances(next.transition.row(i),
                    has_exit ? next.exit[i] : unused,
                    statistics.transitions.row(i).transpose(),
                    has_exit ? statistics.exits[i] : 0.0);
    }
    for (Eigen::Index i = 0; i < next.states(); ++i) {
        double unused = 0.0;
        const Eigen::Index k = next.mixtures();
        set_chances(next.weights.row(i), unused, statistics.occupancy.segment(i * k, k), 0.0);
    }
}

// Full and tied covariances. `shifts`: new mean less old mean. The moments are about the old means,
// so the scatter about the new ones lacks occupancy x shift shift^T.
void set_matrices(GaussianHmm& next,
                  const HmmStatistics& statistics,
                  const Eigen::MatrixXd& shifts,
                  const Eigen::VectorXd& floor) {
    const bool is_tied = next.covariance_type == CovarianceType::tied;
    const Eigen::Index d = next.dimension();
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(d, d);  // of all states, for tied
    for (Eigen::Index n = 0; n < next.states(); ++n) {
        const double occupancy = statistics.occupancy[n];
        if (!(occupancy > 0.0)) {
            continue;
        }
        const std::size_t i = static_cast<std::size_t>(n);
        // Symmetric but for rounding; the average of the matrix and its transpose below makes it
        // exactly so.
        Eigen::MatrixXd scatter = statistics.second[i];
        scatter -= occupancy * shifts.row(n).transpose() * shifts.row(n);
        if (is_tied) {
            sum += scatter;
        } else {
            next.covariances[i] = 0.5 * (scatter + scatter.transpose()) / occupancy;
            next.covariances[i].diagonal() += floor;
        }
    }
    // Tied: one scatter of all states over all frames.
    if (const double total = statistics.occupancy.sum(); is_tied && total > 0.0) {
        next.covariances[0] = 0.5 * (sum + sum.transpose()) / total;
        next.covariances[0].diagonal() += floor;
    }
}

// Diagonal and spherical variances, raised to the floor. The same shift of the origin as above.
void set_variances(GaussianHmm& next,
                   const HmmStatistics& statistics,
                   const Eigen::MatrixXd& shifts,
                   const Eigen::VectorXd& floor) {
    for (Eigen::Index c = 0; c < next.means.rows(); ++c) {
        const double occupancy = statistics.occupancy[c];
        if (!(occupancy > 0.0)) {
            continue;
        }
        const std::size_t i = static_cast<std::size_t>(c);
        const Eigen::VectorXd variance =
            statistics.second[i].col(0) / occupancy - shifts.row(c).transpose().cwiseAbs2();
        // One variance for all features: the mean of theirs.
        if (next.covariance_type == CovarianceType::spherical) {
            next.covariances[i](0, 0) = std::max(variance.mean(), floor.mean());
        } else {
            next.covariances[i].col(0) = variance.cwiseMax(floor);
        }
    }
}

}  // namespace

HmmStatistics HmmStatistics::zero(const GaussianHmm& model) {
    const Eigen::Index n = model.states();
    const Eigen::Index components = model.means.rows();
    const Eigen::Index d = model.dimension();
    HmmStatistics result;
    result.initial = Eigen::VectorXd::Zero(n);
    result.transitions = Eigen::MatrixXd::Zero(n, n);
    result.exits = Eigen::VectorXd::Zero(n);
    result.occupancy = Eigen::VectorXd::Zero(components);
    result.first = Eigen::MatrixXd::Zero(components, d);
    // Only the diagonal of each D x D moment where the covariance has no more.
    const Eigen::Index columns = is_matrix_type(model.covariance_type) ? d : 1;
    result.second.assign(static_cast<std::size_t>(components), Eigen::MatrixXd::Zero(d, columns));
    return result;
}

void HmmStatistics::add(const GaussianHmm& model,
                        const HmmScorer& scorer,
                        const Frames& frames,
                        double weight) {
    const ForwardBackward expected = forward_backward(scorer, scorer.log_emissions(frames));
    // Impossible under this model: its expectations do not exist.
    if (!std::isfinite(expected.log_likelihood)) {
        return;
    }
    add_counts(expected, weight);
    // State by state, over the frames in which the state may be.
    for (Eigen::Index n = 0; n < model.states(); ++n) {
        const Stretch stretch = occupied(expected.posteriors, n);
        add_moments(model,
                    scorer,
                    frames.middleRows(stretch.first, stretch.count),
                    expected.posteriors.middleRows(stretch.first, stretch.count),
                    n,
                    weight);
    }
}

void HmmStatistics::add_aligned(const GaussianHmm& model,
                                const HmmScorer& scorer,
                                const Frames& frames,
                                const ForwardBackward& expected,
                                double weight) {
    add_counts(expected, weight);
    // Over the whole sequence, zeros included: a shorter sum would change the bits of figures that
    // are trained by alignment.
    for (Eigen::Index n = 0; n < model.states(); ++n) {
        add_moments(model, scorer, frames, expected.posteriors, n, weight);
    }
}

void HmmStatistics::add_counts(const ForwardBackward& expected, double weight) {
    log_likelihood += weight * expected.log_likelihood;
    ++used;
    // A sequence starts and ends where its posteriors at the first and last frame say.
    initial += weight * expected.posteriors.row(0).transpose();
    exits += weight * expected.posteriors.row(expected.posteriors.rows() - 1).transpose();
    transitions += weight * expected.transitions;
}

void HmmStatistics::add_moments(const GaussianHmm& model,
                                const HmmScorer& scorer,
                                const Eigen::Ref<const Frames>& frames,
                                const Eigen::Ref<const Frames>& posteriors,
                                Eigen::Index state,
                                double weight) {
    const Frames gammas =
        component_posteriors(scorer, frames, posteriors, static_cast<std::size_t>(state));
    for (Eigen::Index k = 0; k < model.mixtures(); ++k) {
        const Eigen::Index c = state * model.mixtures() + k;
        const Eigen::VectorXd gamma = weight * gammas.col(k);
        // About the model's means, T x D; weighted rows serve both moments.
        const Frames centred = frames.rowwise() - model.means.row(c);
        const Frames weighted = centred.array().colwise() * gamma.array();
        occupancy[c] += gamma.sum();
        first.row(c) += weighted.colwise().sum();
        Eigen::MatrixXd& moment = second[static_cast<std::size_t>(c)];
        if (is_matrix_type(model.covariance_type)) {
            moment.noalias() += weighted.transpose() * centred;
        } else {
            moment.col(0) += weighted.cwiseProduct(centred).colwise().sum().transpose();
        }
    }
}

void HmmStatistics::merge(const HmmStatistics& other) {
    log_likelihood += other.log_likelihood;
    used += other.used;
    initial += other.initial;
    transitions += other.transitions;
    exits += other.exits;
    occupancy += other.occupancy;
    first += other.first;
    for (std::size_t i = 0; i < second.size(); ++i) {
        second[i] += other.second[i];
    }
}

// Unoccupied components have shift 0 and keep mean and covariance.
GaussianHmm re_estimated(const GaussianHmm& model,
                         const HmmStatistics& statistics,
                         const Eigen::VectorXd& floor) {
    GaussianHmm next = model;
    set_topology(next, statistics);
    // The first moments are about the old means: divided by the occupancy they are the shifts.
    Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(model.means.rows(), model.dimension());
    for (Eigen::Index c = 0; c < model.means.rows(); ++c) {
        if (statistics.occupancy[c] > 0.0) {
            shifts.row(c) = statistics.first.row(c) / statistics.occupancy[c];
        }
    }
    next.means += shifts;
    if (is_matrix_type(model.covariance_type)) {
        set_matrices(next, statistics, shifts, floor);
    } else {
        set_variances(next, statistics, shifts, floor);
    }
    return next;
}

}  // namespace raks::models
