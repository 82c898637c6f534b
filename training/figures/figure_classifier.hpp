#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "models/hmm_scorer.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/figure_trainer.hpp"

/// Classifies figures by the log-likelihood of a repetition under the HMMs of their parts.
namespace raks::motion {

/// One repetition of a known figure.
struct FigureExample {
    std::string take;          ///< the clip's name
    double start = 0.0;        ///< frame of count 1
    std::size_t figure = 0;    ///< among those to be told apart
    double weight = 1.0;       ///< how much it counts in training, > 0
    std::vector<Pose> phased;  ///< poses_on_phase
};

/// The repeats of one figure as examples.
[[nodiscard]] std::vector<FigureExample> examples_of(std::size_t figure,
                                                     std::span<const TrainingClip> clips,
                                                     std::span<const FigureRepeat> repeats,
                                                     const FigureTrainingOptions& training);

/// Mean log-likelihoods a sample, in nats, by figure and Part; 0 for a part that figures with these
/// features do not have.
using FigureScores = std::vector<std::array<double, 3>>;

/// How much each part's log-likelihood counts, by Part: evidence = sum of weight x nats a sample.
/// The size matters when the evidence of two dancers is added.
using PartWeights = std::array<double, 3>;

/// One HMM for each part of each figure.
class FigureClassifier {
 public:
    /// Trains a left-to-right HMM for every part of every figure (the parts of training.features):
    /// training.states states, training.covariance, training.baum_welch_iterations rounds. All
    /// figures share one set of mean joint rotations, taken over all examples, so that
    /// log-likelihoods of different figures are densities of the same features. Errors: a figure
    /// without an example.
    [[nodiscard]] static Expected<FigureClassifier> learn(std::span<const FigureExample> examples,
                                                          std::size_t figures,
                                                          const FigureTrainingOptions& training);

    /// Log-likelihoods of the example under every figure. Threads: any. Real-time: no.
    [[nodiscard]] FigureScores score(const FigureExample& example) const;

 private:
    int samples_per_beat_ = 24;
    std::vector<PartModel> joints_;                        // of each part; no states
    std::vector<std::vector<models::HmmScorer>> scorers_;  // by figure, then as joints_
};

/// Weighted sums of the parts' log-likelihoods, one a figure; nats a sample.
[[nodiscard]] std::vector<double> evidence(const FigureScores& scores, const PartWeights& weights);

/// The figure with the most evidence; ties: the first.
[[nodiscard]] std::size_t most_likely(std::span<const double> evidence);

/// Scores of one example whose figure is known.
struct ScoredExample {
    std::size_t figure = 0;  ///< its own
    FigureScores scores;     ///< under every figure
};

/// The weights that maximize the posterior probability of the examples' own figures, with evidence
/// as the log-probability up to a constant (discriminative model combination: Beyerlein 1998).
/// Searched on a grid: shares of the parts in steps of 1/20, total sizes in powers of the square
/// root of 2.
[[nodiscard]] PartWeights fit_weights(std::span<const ScoredExample> examples);

}  // namespace raks::motion
