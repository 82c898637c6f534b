#include "training/figures/classifier_evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/parallel.hpp"

namespace raks::motion {
namespace {

// The takes' names, each once, in order of first appearance.
std::vector<std::string> takes_of(std::span<const FigureExample> examples) {
    std::vector<std::string> takes;
    for (const FigureExample& example : examples) {
        if (std::find(takes.begin(), takes.end(), example.take) == takes.end()) {
            takes.push_back(example.take);
        }
    }
    return takes;
}

// Each figure needs two takes: with one left out, the other still has to teach it.
Expected<void> check(std::span<const std::string> figures, const DancerExamples& dancer) {
    if (figures.size() < 2) {
        return fail("needs two figures or more to tell apart");
    }
    for (std::size_t f = 0; f < figures.size(); ++f) {
        std::set<std::string> takes;
        for (const FigureExample& example : dancer.training) {
            if (example.figure == f) {
                takes.insert(example.take);
            }
        }
        if (takes.size() < 2) {
            return fail(
                fmt::format("{} of the {} is in {} of the takes to learn from, must be in "
                            "two or more: one is left out",
                            figures[f],
                            kRoleNames[static_cast<std::size_t>(dancer.role)],
                            takes.size()));
        }
    }
    return {};
}

/// The training examples, each scored by a classifier that did not learn from its take.
Expected<std::vector<ScoredExample>> scored_with_takes_left_out(
    std::span<const FigureExample> examples,
    std::size_t figures,
    const FigureTrainingOptions& training,
    int threads) {
    // One classifier a take, trained in parallel. Each job writes to its own slots of `scored` and
    // `errors`, so the result does not depend on the number of threads.
    const std::vector<std::string> takes = takes_of(examples);
    std::vector<ScoredExample> scored(examples.size());
    std::vector<std::optional<Error>> errors(takes.size());
    run_parallel(takes.size(), threads, [&](std::size_t i) {
        std::vector<FigureExample> others;
        std::copy_if(examples.begin(),
                     examples.end(),
                     std::back_inserter(others),
                     [&](const FigureExample& example) { return example.take != takes[i]; });
        const Expected<FigureClassifier> classifier =
            FigureClassifier::learn(others, figures, training);
        if (!classifier) {
            errors[i] = classifier.error();
            return;
        }
        for (std::size_t e = 0; e < examples.size(); ++e) {
            if (examples[e].take == takes[i]) {
                scored[e] = {examples[e].figure, classifier->score(examples[e])};
            }
        }
    });
    // The error of the first take, whichever job failed first.
    for (const std::optional<Error>& error : errors) {
        if (error) {
            return fail(*error);
        }
    }
    return scored;
}

// Decisions by the weighted sum of the parts' log-likelihoods.
Decisions decisions_on(std::span<const ScoredExample> examples,
                       std::size_t figures,
                       const PartWeights& weights) {
    Decisions decisions = no_decisions(figures);
    for (const ScoredExample& example : examples) {
        decisions.add(example.figure, evidence(example.scores, weights));
    }
    return decisions;
}

/// A dancer with the scores of the unseen examples, in their order.
struct Judged {
    DancerEvaluation evaluation;
    std::vector<ScoredExample> unseen;
};

// Weights are fitted to scores of left-out takes: scores of examples that the models have learnt
// from would favour the parts that overfit
// most.
Expected<Judged> judge(const DancerExamples& dancer,
                       std::size_t figures,
                       const FigureTrainingOptions& training,
                       int threads) {
    const Expected<std::vector<ScoredExample>> left_out =
        scored_with_takes_left_out(dancer.training, figures, training, threads);
    if (!left_out) {
        return fail(left_out.error());
    }
    const Expected<FigureClassifier> classifier =
        FigureClassifier::learn(dancer.training, figures, training);
    if (!classifier) {
        return fail(classifier.error());
    }
    Judged judged;
    for (const FigureExample& example : dancer.unseen) {
        judged.unseen.push_back({example.figure, classifier->score(example)});
    }
    DancerEvaluation& evaluation = judged.evaluation;
    evaluation.role = dancer.role;
    evaluation.weights = fit_weights(*left_out);
    evaluation.left_out = decisions_on(*left_out, figures, evaluation.weights);
    evaluation.unseen = decisions_on(judged.unseen, figures, evaluation.weights);
    // Each part alone: what its log-likelihood is worth without the others.
    for (std::size_t p = 0; p < kParts.size(); ++p) {
        PartWeights alone{};
        alone[p] = 1.0;
        evaluation.unseen_by_part[p] = decisions_on(judged.unseen, figures, alone);
    }
    return judged;
}

/// What identifies a pair of takes: both dancers of "60_03" and "61_03" danced together.
std::string_view pair_of(std::string_view take) { return take.substr(take.find('_') + 1); }

// True when two examples show the same repetition of both dancers.
bool are_together(const FigureExample& a, const FigureExample& b) {
    constexpr double kSameStart = 15.0;  // frames: well under a beat
    return a.figure == b.figure && pair_of(a.take) == pair_of(b.take) &&
           std::abs(a.start - b.start) < kSameStart;
}

}  // namespace

Decisions no_decisions(std::size_t figures) {
    const std::vector<std::vector<int>> none(figures, std::vector<int>(figures, 0));
    return {none, none};
}

void Decisions::add(std::size_t figure, std::span<const double> evidence) {
    ++confusion[figure][most_likely(evidence)];
    // Ties count against the figure, except with itself.
    for (std::size_t other = 0; other < evidence.size(); ++other) {
        pairwise[figure][other] += other == figure || evidence[figure] > evidence[other] ? 1 : 0;
    }
}

int Decisions::right() const noexcept {
    int sum = 0;
    for (std::size_t f = 0; f < confusion.size(); ++f) {
        sum += confusion[f][f];
    }
    return sum;
}

int Decisions::total() const noexcept {
    // The diagonal of `pairwise` counts every example of its figure.
    int sum = 0;
    for (std::size_t f = 0; f < pairwise.size(); ++f) {
        sum += pairwise[f][f];
    }
    return sum;
}

int Decisions::right_between(std::size_t a, std::size_t b) const noexcept {
    return pairwise[a][b] + pairwise[b][a];
}

int Decisions::total_of(std::size_t a, std::size_t b) const noexcept {
    return pairwise[a][a] + pairwise[b][b];
}

Expected<ClassifierEvaluation> evaluate_classifier(std::span<const std::string> figures,
                                                   std::span<const DancerExamples> dancers,
                                                   const FigureTrainingOptions& training,
                                                   int threads) {
    ClassifierEvaluation result;
    result.figures.assign(figures.begin(), figures.end());
    std::vector<std::vector<ScoredExample>> unseen;
    for (const DancerExamples& dancer : dancers) {
        if (auto ok = check(figures, dancer); !ok) {
            return fail(std::move(ok.error()));
        }
        Expected<Judged> judged = judge(dancer, figures.size(), training, threads);
        if (!judged) {
            return fail(std::move(judged.error()));
        }
        result.dancers.push_back(std::move(judged->evaluation));
        unseen.push_back(std::move(judged->unseen));
    }
    if (dancers.size() != 2) {
        return result;
    }
    // Both dancers dance the same figure, so their log-probabilities add. The fitted weights of
    // each dancer put both on one scale.
    result.couple = no_decisions(figures.size());
    for (std::size_t i = 0; i < unseen[0].size(); ++i) {
        for (std::size_t j = 0; j < unseen[1].size(); ++j) {
            if (are_together(dancers[0].unseen[i], dancers[1].unseen[j])) {
                std::vector<double> sums = evidence(unseen[0][i].scores, result.dancers[0].weights);
                const std::vector<double> others =
                    evidence(unseen[1][j].scores, result.dancers[1].weights);
                for (std::size_t f = 0; f < sums.size(); ++f) {
                    sums[f] += others[f];
                }
                result.couple.add(unseen[0][i].figure, sums);
            }
        }
    }
    return result;
}

}  // namespace raks::motion
