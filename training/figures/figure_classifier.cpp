#include "training/figures/figure_classifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "motion/figures/figure_hmm.hpp"
#include "training/figures/repeat_features.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::motion {
namespace {

/// Sum over the examples of ln of their own figure's posterior: a softmax over the figures'
/// evidence.
double log_posterior(std::span<const ScoredExample> examples, const PartWeights& weights) {
    double sum = 0.0;
    for (const ScoredExample& example : examples) {
        const std::vector<double> sums = evidence(example.scores, weights);
        sum += sums[example.figure] - models::log_sum(sums);
    }
    return sum;
}

}  // namespace

std::vector<FigureExample> examples_of(std::size_t figure,
                                       std::span<const TrainingClip> clips,
                                       std::span<const FigureRepeat> repeats,
                                       const FigureTrainingOptions& training) {
    // On the phase axis all examples of a figure have as many samples, whatever their tempo.
    std::vector<std::vector<Pose>> phased =
        phased_repeats(clips, repeats, training.samples_per_beat, training.low_pass_hz);
    std::vector<FigureExample> examples;
    for (std::size_t r = 0; r < repeats.size(); ++r) {
        examples.push_back({clips[repeats[r].clip].name,
                            repeats[r].beat_frames.front(),
                            figure,
                            repeats[r].weight,
                            std::move(phased[r])});
    }
    return examples;
}

Expected<FigureClassifier> FigureClassifier::learn(std::span<const FigureExample> examples,
                                                   std::size_t figures,
                                                   const FigureTrainingOptions& training) {
    std::vector<std::vector<Pose>> phased;
    std::vector<double> weights;
    for (const FigureExample& example : examples) {
        phased.push_back(example.phased);
        weights.push_back(example.weight);
    }
    FigureClassifier classifier;
    classifier.scorers_.resize(figures);
    classifier.samples_per_beat_ = training.samples_per_beat;
    // One set of joint means for all figures of a part: densities are comparable only over the same
    // features.
    for (const Part which : parts_of(training.features)) {
        const PartModel& joints =
            classifier.joints_.emplace_back(mean_joints(which, phased, weights, training.features));
        std::vector<models::TrainingSet> sets(figures);
        for (const FigureExample& example : examples) {
            models::TrainingSet& set = sets[example.figure];
            set.sequences.push_back(part_frames(example.phased, joints, training.samples_per_beat));
            set.weights.push_back(example.weight);
        }
        // One HMM for each figure, on that figure's examples alone.
        for (std::size_t f = 0; f < figures; ++f) {
            const Expected<models::TrainingResult> learnt =
                learn_states(sets[f], training.learning());
            if (!learnt) {
                return fail(fmt::format("figure {}, {}: {}",
                                        f + 1,
                                        kPartNames[static_cast<std::size_t>(which)],
                                        learnt.error().message));
            }
            Expected<models::HmmScorer> scorer = models::HmmScorer::create(learnt->model);
            if (!scorer) {
                return fail(std::move(scorer.error()));
            }
            classifier.scorers_[f].push_back(std::move(*scorer));
        }
    }
    return classifier;
}

FigureScores FigureClassifier::score(const FigureExample& example) const {
    FigureScores scores(scorers_.size());
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        // The features of a part are computed once and scored by every figure's HMM. Dividing by T
        // gives nats a sample, so that long and short examples weigh alike in fit_weights.
        const models::Frames frames = part_frames(example.phased, joints_[p], samples_per_beat_);
        for (std::size_t f = 0; f < scorers_.size(); ++f) {
            scores[f][static_cast<std::size_t>(joints_[p].part)] =
                models::log_likelihood(scorers_[f][p], frames) / static_cast<double>(frames.rows());
        }
    }
    return scores;
}

std::vector<double> evidence(const FigureScores& scores, const PartWeights& weights) {
    std::vector<double> sums;
    for (const std::array<double, 3>& score : scores) {
        sums.push_back(weights[0] * score[0] + weights[1] * score[1] + weights[2] * score[2]);
    }
    return sums;
}

std::size_t most_likely(std::span<const double> evidence) {
    return static_cast<std::size_t>(std::max_element(evidence.begin(), evidence.end()) -
                                    evidence.begin());
}

PartWeights fit_weights(std::span<const ScoredExample> examples) {
    constexpr int kSteps = 20;  // a share of 1 is this many steps; the three shares sum to 1
    PartWeights best = {1.0, 1.0, 1.0};
    double best_value = log_posterior(examples, best);
    // Sizes from 1/8 to 32: the total weight sets how sharp the posterior is.
    for (int half_octave = -6; half_octave <= 10; ++half_octave) {
        const double size = std::exp2(0.5 * half_octave);
        for (int torso = 0; torso <= kSteps; ++torso) {
            for (int upper = 0; torso + upper <= kSteps; ++upper) {
                const PartWeights weights = {size * torso / kSteps,
                                             size * upper / kSteps,
                                             size * (kSteps - torso - upper) / kSteps};
                // Strictly greater: of equals the first stays, so the result is deterministic.
                if (const double value = log_posterior(examples, weights); value > best_value) {
                    best_value = value;
                    best = weights;
                }
            }
        }
    }
    return best;
}

}  // namespace raks::motion
