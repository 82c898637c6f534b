#pragma once

#include <span>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "models/hmm_scorer.hpp"

namespace raks::models {

/// Expected counts and moments of a set under a model: what the E-step collects and the M-step
/// turns into the next model. Moments are about the model's own means, so that large offsets in a
/// feature do not cancel its variance.
struct HmmStatistics {
    double log_likelihood = 0.0;
    std::size_t used = 0;         ///< sequences
    Eigen::VectorXd initial;      ///< N
    Eigen::MatrixXd transitions;  ///< N x N
    Eigen::VectorXd exits;        ///< N
    Eigen::VectorXd occupancy;    ///< N K
    Eigen::MatrixXd first;        ///< N K x D
    /// Full and tied: N of D x D; diagonal and spherical: N K of D x 1.
    std::vector<Eigen::MatrixXd> second;

    [[nodiscard]] static HmmStatistics zero(const GaussianHmm& model);

    /// Adds the expectations of one sequence, `weight` times. Impossible ones are left out.
    void add(const GaussianHmm& model,
             const HmmScorer& scorer,
             const Frames& frames,
             double weight);
    /// Adds one sequence with a known posterior (T x N) and transition counts.
    void add_aligned(const GaussianHmm& model,
                     const HmmScorer& scorer,
                     const Frames& frames,
                     const ForwardBackward& expected,
                     double weight);
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

/// M-step. `floor`: D, what is kept under every variance (BaumWelchOptions::variance_floor).
[[nodiscard]] GaussianHmm re_estimated(const GaussianHmm& model,
                                       const HmmStatistics& statistics,
                                       const Eigen::VectorXd& floor);

}  // namespace raks::models
