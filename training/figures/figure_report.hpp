#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/state_selection.hpp"

/// What the states of a figure mean: the data behind the paper's Figs. 11 to 14. States have free
/// durations here (Baum-Welch, Viterbi), as in the paper; the dancer's own lie on equal slices.
namespace raks::motion {

/// One feature over the phase, in a few repeats.
struct FeatureCurve {
    std::string name;                          ///< "left lower leg, x"
    std::string unit;                          ///< "rad", or "m"
    double explained = 0.0;                    ///< share of its variance between the states
    std::vector<std::vector<double>> repeats;  ///< T values of each shown repeat
    std::vector<double> state_means;           ///< N
};

struct PartReport {
    PartSelection selection;
    /// Of each repeat, the state of each of its T samples (Viterbi), under the chosen number.
    std::vector<std::vector<std::size_t>> paths;
    /// Row c, column k: the share of count c + 1 (all repeats) that is spent in state k; rows sum
    /// to 1.
    std::vector<std::vector<double>> occurrence;
    /// Of each state, its length in each repeat; beats.
    std::vector<std::vector<double>> stays;
    /// Of different joints, the two features that move most from state to state.
    std::vector<FeatureCurve> curves;

    [[nodiscard]] std::size_t states() const noexcept { return stays.size(); }
};

struct FigureReport {
    std::string figure;
    DanceRole role = DanceRole::lead;
    int beats = 8;
    int samples_per_beat = 24;
    std::vector<std::string> takes;               ///< of each repeat
    std::vector<std::vector<std::string>> folds;  ///< StateSelection::folds
    std::vector<std::size_t> shown;               ///< repeats in the curves, at most four
    FigureFeatures features = FigureFeatures::angles;
    std::array<PartReport, 3> parts;  ///< by Part; parts_of(features) are filled
};

/// Selects the states, learns the parts with them from all repeats and follows every repeat
/// through them. Deterministic, whatever the number of threads. Errors: those of select_states.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureReport> report_figure(std::span<const TrainingClip> clips,
                                                   std::span<const FigureRepeat> repeats,
                                                   const FigureTrainingOptions& training,
                                                   const StateSelectionOptions& options = {});

/// "hips forward", "left lower leg, x" and the like, and the unit.
[[nodiscard]] std::string feature_name(const PartModel& part, std::size_t feature);
[[nodiscard]] std::string feature_unit(const PartModel& part, std::size_t feature);

}  // namespace raks::motion
