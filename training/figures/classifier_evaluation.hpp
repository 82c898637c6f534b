#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "training/figures/figure_classifier.hpp"

/// How well figures are told apart on takes that were not learnt from.
namespace raks::motion {

/// Decisions on a set of examples, all by figure.
struct Decisions {
    /// Row: the figure danced; column: the figure taken for it; number of examples.
    std::vector<std::vector<int>> confusion;
    /// Examples of the row's figure with more evidence for it than for the column's: what remains
    /// right when only these two are asked for. On the diagonal: all examples of the figure.
    std::vector<std::vector<int>> pairwise;

    void add(std::size_t figure, std::span<const double> evidence);
    [[nodiscard]] int right() const noexcept;
    [[nodiscard]] int total() const noexcept;
    /// Of both figures' examples, right ones between the two, and all.
    [[nodiscard]] int right_between(std::size_t a, std::size_t b) const noexcept;
    [[nodiscard]] int total_of(std::size_t a, std::size_t b) const noexcept;
};
[[nodiscard]] Decisions no_decisions(std::size_t figures);

/// All that one dancer's motion gave.
struct DancerExamples {
    DanceRole role = DanceRole::lead;
    std::vector<FigureExample> training;
    std::vector<FigureExample> unseen;  ///< of other takes; may be empty
};

struct DancerEvaluation {
    DanceRole role = DanceRole::lead;
    PartWeights weights{};  ///< fitted to the training examples, each scored with its take left out
    Decisions left_out;     ///< on those same examples
    Decisions unseen;
    std::array<Decisions, 3> unseen_by_part;  ///< each part alone, by Part
};

struct ClassifierEvaluation {
    std::vector<std::string> figures;
    std::vector<DancerEvaluation> dancers;
    /// Both dancers' evidence added, over unseen examples that both have: the takes' names agree
    /// behind the first '_' and the starts within 15 frames. Empty with one dancer.
    Decisions couple;
};

/// Learns the figures from each dancer's training examples, with one take left out at a time to
/// weight the parts, then from all of them to judge the unseen ones. Any number of threads gives
/// the same bits. Errors: fewer than two figures; a figure that only one take, or none, has.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<ClassifierEvaluation> evaluate_classifier(
    std::span<const std::string> figures,
    std::span<const DancerExamples> dancers,
    const FigureTrainingOptions& training,
    int threads);

}  // namespace raks::motion
