#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "models/gaussian_hmm.hpp"

/// Training of Gaussian HMMs.
namespace raks::models {

/// Training data: sequences of frames, all of the same dimension.
struct TrainingSet {
    std::vector<Frames> sequences;  ///< each T x D; T may differ
    /// How much each sequence counts, >= 0; empty: 1 each.
    std::vector<double> weights;
};

/// When Baum-Welch ends, and the floors of its variances.
struct BaumWelchOptions {
    int iterations = 20;  ///< most rounds; 0: only computes the log-likelihood
    /// Stop when an iteration gains less than this, in nats a frame. 0: never stop early.
    double tolerance = 1e-5;
    /// Floor under every variance, as a share of the feature's variance over the whole set, but at
    /// least `absolute_floor`. Diagonal and spherical variances are raised to the floor; to full
    /// and tied covariances it is added on the diagonal (so that a constant feature, or fewer
    /// frames than features, leave the matrix positive definite). With both 0: plain maximum
    /// likelihood.
    double variance_floor = 1e-3;
    double absolute_floor = 1e-8;  ///< in squared units of the feature
    int threads = 1;               ///< of the E-step; any number gives the same bits
};

/// The trained model and how training went.
struct TrainingResult {
    GaussianHmm model;  ///< the last one
    /// Weighted ln p of the set before each iteration and after the last.
    std::vector<double> log_likelihoods;
    std::size_t skipped = 0;  ///< sequences that the start model cannot produce
};

/// Baum-Welch: maximum-likelihood re-estimation over several sequences (Rabiner 1989, section V-B;
/// Gaussian mixtures: III-C). Transitions, entries and exits that are 0 stay 0; a state that
/// nothing reaches keeps what it had, so no row becomes zero. Statistics are summed in chunks of 32
/// sequences and merged in order.
/// Errors: an invalid start model, another dimension, a value that is not finite, no sequence that
/// the start model can produce. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TrainingResult> baum_welch(const GaussianHmm& start,
                                                  const TrainingSet& set,
                                                  const BaumWelchOptions& options = {});

/// Start of a left-to-right model: each sequence is cut into `states` equal slices; slice n gives
/// mean and covariance of state n, the mean slice length its duration. (HTK's flat start, per
/// state.)
/// Errors: no sequence of at least `states` frames, and those of the data above.
[[nodiscard]] Expected<GaussianHmm> sliced_start(Eigen::Index states,
                                                 CovarianceType type,
                                                 const TrainingSet& set,
                                                 const BaumWelchOptions& options = {});

/// As sliced_start, then the state boundaries are re-estimated: each round finds every sequence's
/// Viterbi path and takes the maximum-likelihood model of these paths, until no path changes (at
/// most 30 rounds). (Segmental k-means, Juang and Rabiner 1990; HTK's HInit.) Without floors the
/// joint likelihood of data and paths never falls. Errors: as sliced_start.
[[nodiscard]] Expected<GaussianHmm> segmental_start(Eigen::Index states,
                                                    CovarianceType type,
                                                    const TrainingSet& set,
                                                    const BaumWelchOptions& options = {});

/// The maximum-likelihood model of a known alignment: `states_of[s][t]` is the state of frame t of
/// sequence s. Topology from `start`: transitions that are 0 there stay 0.
[[nodiscard]] Expected<GaussianHmm> from_alignment(
    const GaussianHmm& start,
    const TrainingSet& set,
    std::span<const std::vector<std::size_t>> states_of,
    const BaumWelchOptions& options = {});

/// Adds one mixture component to each state: the heaviest is split into two halves whose means are
/// moved 0.2 standard deviations to either side (HTK's MU). Diagonal covariances only.
[[nodiscard]] GaussianHmm split_heaviest(const GaussianHmm& model);

}  // namespace raks::models
