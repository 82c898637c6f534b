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

/// What the states of a figure stand for: the data behind the paper's Figs. 11 to 14. As in the
/// paper, states have free durations here (Baum-Welch, Viterbi); those that the dancer plays lie on
/// equal slices of the phase.
namespace raks::motion {

/// One feature over the phase, in a few repeats.
struct FeatureCurve {
    std::string name;        ///< "left lower leg, x"
    std::string unit;        ///< feature_unit
    double explained = 0.0;  ///< share of its variance that lies between the states, 0 to 1
    std::vector<std::vector<double>> repeats;  ///< T values of each shown repeat
    std::vector<double> state_means;           ///< N
};

/// States, timing and the most telling features of one part.
struct PartReport {
    PartSelection selection;  ///< the tried numbers of states and the chosen one
    /// Of each repeat, the state of each of its T samples (Viterbi), under the chosen number.
    std::vector<std::vector<std::size_t>> paths;
    /// Row c, column k: the share of count c + 1 (all repeats) that is spent in state k; rows sum
    /// to 1.
    std::vector<std::vector<double>> occurrence;
    /// Of each state, its length in each repeat; beats.
    std::vector<std::vector<double>> stays;
    /// The features with the largest variance between the states, at most two, of different joints.
    std::vector<FeatureCurve> curves;

    /// N, the chosen number of states.
    [[nodiscard]] std::size_t states() const noexcept { return stays.size(); }
};

/// Everything that is shown about one figure of one role.
struct FigureReport {
    std::string figure;                                ///< name
    DanceRole role = DanceRole::lead;                  ///< whose motion it is
    int beats = 8;                                     ///< of one repeat
    int samples_per_beat = 24;                         ///< T = beats x samples_per_beat
    std::vector<std::string> takes;                    ///< of each repeat
    std::vector<std::vector<std::string>> folds;       ///< StateSelection::folds
    std::vector<std::size_t> shown;                    ///< repeats in the curves, at most four
    FigureFeatures features = FigureFeatures::angles;  ///< of the parts
    std::array<PartReport, 3> parts;                   ///< by Part; parts_of(features) are filled
};

/// Selects the number of states, trains every part on all repeats and finds each repeat's Viterbi
/// path. Deterministic, whatever the number of threads. Errors: those of select_states.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureReport> report_figure(std::span<const TrainingClip> clips,
                                                   std::span<const FigureRepeat> repeats,
                                                   const FigureTrainingOptions& training,
                                                   const StateSelectionOptions& options = {});

/// A feature in words: "hips forward", "left lower leg, x".
[[nodiscard]] std::string feature_name(const PartModel& part, std::size_t feature);
/// Its unit: "rad", "m", "m a beat" or "rad a beat".
[[nodiscard]] std::string feature_unit(const PartModel& part, std::size_t feature);

}  // namespace raks::motion
