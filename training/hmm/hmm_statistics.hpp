#pragma once

#include <span>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "models/hmm_scorer.hpp"

namespace raks::models {

/// Expected counts and moments of a training set under a model: the E-step collects them, the
/// M-step makes the next model of them. Moments are about the model's own means, so that a large
/// offset of a feature does not cancel its variance.
struct HmmStatistics {
    double log_likelihood = 0.0;  ///< weighted, over the sequences used; nats
    std::size_t used = 0;         ///< number of sequences added
    Eigen::VectorXd initial;      ///< N, expected starts
    Eigen::MatrixXd transitions;  ///< N x N, expected transitions (sum of xi)
    Eigen::VectorXd exits;        ///< N, expected ends
    Eigen::VectorXd occupancy;    ///< N K, sum of gamma of each component
    Eigen::MatrixXd first;        ///< N K x D, sum of gamma times (o - mean)
    /// Sums of gamma times (o - mean)(o - mean)^T. Full and tied: N of D x D; diagonal and
    /// spherical: N K of D x 1, the diagonal alone.
    std::vector<Eigen::MatrixXd> second;

    /// All zeros, in the shapes of this model.
    [[nodiscard]] static HmmStatistics zero(const GaussianHmm& model);

    /// Adds the expectations of one sequence, `weight` times. Sequences that the model cannot
    /// produce are skipped.
    void add(const GaussianHmm& model,
             const HmmScorer& scorer,
             const Frames& frames,
             double weight);
    /// Adds one sequence with known posteriors (T x N) and transition counts, as of an alignment.
    void add_aligned(const GaussianHmm& model,
                     const HmmScorer& scorer,
                     const Frames& frames,
                     const ForwardBackward& expected,
                     double weight);
    /// Adds the sums of another set. The last bits depend on the order of merging.
    void merge(const HmmStatistics& other);

 private:
    void add_counts(const ForwardBackward& expected, double weight);
    /// Moments of one state's components over a stretch of frames and its posteriors.
    void add_moments(const GaussianHmm& model,
                     const HmmScorer& scorer,
                     const Eigen::Ref<const Frames>& frames,
                     const Eigen::Ref<const Frames>& posteriors,
                     Eigen::Index state,
                     double weight);
};

/// M-step: the maximum-likelihood model of these statistics. `floor`: D, the floor under the
/// variances (BaumWelchOptions::variance_floor). States without occupancy keep what they had.
[[nodiscard]] GaussianHmm re_estimated(const GaussianHmm& model,
                                       const HmmStatistics& statistics,
                                       const Eigen::VectorXd& floor);

}  // namespace raks::models
