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

/// Figures told apart by how well the models of their parts explain a repetition.
namespace raks::motion {

/// One repetition of a known figure.
struct FigureExample {
    std::string take;        ///< the clip's name
    double start = 0.0;      ///< frame of count 1
    std::size_t figure = 0;  ///< among those to be told apart
    double weight = 1.0;
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

class FigureClassifier {
 public:
    /// A left-to-right HMM for every part of every figure (those of training.features):
    /// training.states states, a tied
    /// covariance, training.baum_welch_iterations rounds. Joints' mean rotations are those of all
    /// examples, so that likelihoods are of the same features. Errors: a figure without an example.
    [[nodiscard]] static Expected<FigureClassifier> learn(std::span<const FigureExample> examples,
                                                          std::size_t figures,
                                                          const FigureTrainingOptions& training);

    /// Threads: any. Real-time: no.
    [[nodiscard]] FigureScores score(const FigureExample& example) const;

 private:
    int samples_per_beat_ = 24;
    std::vector<PartModel> joints_;                        // of each part; no states
    std::vector<std::vector<models::HmmScorer>> scorers_;  // by figure, then as joints_
};

/// The weighted sums, by figure.
[[nodiscard]] std::vector<double> evidence(const FigureScores& scores, const PartWeights& weights);

/// The figure with the most evidence; ties: the first.
[[nodiscard]] std::size_t most_likely(std::span<const double> evidence);

/// One scored example and what it is.
struct ScoredExample {
    std::size_t figure = 0;
    FigureScores scores;
};

/// The weights under which the examples' own figures are most probable, each figure's evidence
/// taken for the logarithm of its share (discriminative model combination: Beyerlein 1998).
/// Searched on a grid: shares of the parts in steps of 1/20, sizes in powers of the square root
/// of 2.
[[nodiscard]] PartWeights fit_weights(std::span<const ScoredExample> examples);

}  // namespace raks::motion
