#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "training/figures/figure_classifier.hpp"

/// Cross-validation of the figure classifier: training scores with one take left out at a time, and
/// scores on unseen takes.
namespace raks::motion {

/// Counts of decisions on a set of examples; rows and columns are figures.
struct Decisions {
    /// Row: the figure danced; column: the figure taken for it; number of examples.
    std::vector<std::vector<int>> confusion;
    /// Examples of the row's figure with more evidence for it than for the column's: right
    /// decisions between these two figures alone. On the diagonal: all examples of the figure.
    std::vector<std::vector<int>> pairwise;

    /// Counts one example of `figure`. `evidence`: one number a figure; the highest one decides.
    void add(std::size_t figure, std::span<const double> evidence);
    /// Examples whose own figure had the most evidence.
    [[nodiscard]] int right() const noexcept;
    /// All examples.
    [[nodiscard]] int total() const noexcept;
    /// Of the examples of a and b: those decided rightly when only these two figures are asked for.
    [[nodiscard]] int right_between(std::size_t a, std::size_t b) const noexcept;
    /// All examples of a and b.
    [[nodiscard]] int total_of(std::size_t a, std::size_t b) const noexcept;
};
/// Zero counts for so many figures.
[[nodiscard]] Decisions no_decisions(std::size_t figures);

/// All examples of one dancer.
struct DancerExamples {
    DanceRole role = DanceRole::lead;  ///< the dancer's
    /// What the models learn from: two takes or more of each figure.
    std::vector<FigureExample> training;
    std::vector<FigureExample> unseen;  ///< of other takes; may be empty
};

/// Weights and decisions for one dancer.
struct DancerEvaluation {
    DanceRole role = DanceRole::lead;  ///< the dancer's
    PartWeights weights{};  ///< fitted to the training examples, each scored with its take left out
    Decisions left_out;     ///< on those same examples
    Decisions unseen;       ///< of models that learnt from all training examples
    std::array<Decisions, 3> unseen_by_part;  ///< each part alone, by Part
};

/// Result of evaluate_classifier.
struct ClassifierEvaluation {
    std::vector<std::string> figures;       ///< names, in the order of rows and columns
    std::vector<DancerEvaluation> dancers;  ///< in the order given
    /// Decisions by the sum of both dancers' evidence, on unseen examples that both have: the
    /// takes' names agree after the first '_', and the starts within 15 frames. Empty with one
    /// dancer.
    Decisions couple;
};

/// Fits each dancer's part weights on training examples scored with their own take left out, then
/// scores the unseen examples with models of all training examples. The same bits for any number of
/// threads. Errors: fewer than two figures; a figure that fewer than two takes of a dancer have.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<ClassifierEvaluation> evaluate_classifier(
    std::span<const std::string> figures,
    std::span<const DancerExamples> dancers,
    const FigureTrainingOptions& training,
    int threads);

}  // namespace raks::motion
