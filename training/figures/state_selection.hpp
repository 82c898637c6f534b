#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/figure_trainer.hpp"

/// How many states a part needs: judged by the log-likelihood of held-out takes (Ofli 2008, section
/// 4.1).
namespace raks::motion {

/// Range of states and rule of choice.
struct StateSelectionOptions {
    int fewest = 2;   ///< as in the paper
    int most = 19;    ///< as in the paper; not more than samples
    int threads = 1;  ///< any number gives the same bits
    /// Takes are left out one by one, or in this many groups where there are more takes.
    std::size_t most_folds = 7;
    /// Saturation: choose the fewest states whose held-out log-likelihood lacks at most this share
    /// of the gain from the worst number of states up to the peak. The share is one of the gain
    /// because log-likelihoods have no natural zero: they shift with the features' units.
    double saturation = 0.05;
};

/// Cross-validation scores of one number of states: mean log-likelihoods a sample over the folds'
/// repeats, nats.
struct StatesTried {
    int states = 0;         ///< N
    double training = 0.0;  ///< of the repeats that the fold learnt from
    double held_out = 0.0;  ///< of the repeats of the takes left out
};

/// The scores and the choice for one part.
struct PartSelection {
    std::vector<StatesTried> tried;  ///< by rising number of states
    int peak = 0;                    ///< states with the highest held-out value; ties: the fewest
    int chosen = 0;                  ///< by saturation; never more than the peak
};

/// Result of select_states.
struct StateSelection {
    std::vector<std::vector<std::string>> folds;  ///< the takes left out together
    std::array<PartSelection, 3> parts;           ///< by Part; empty: not of these features
};

/// Trains every part of the features with every number of states on every fold, as `training` says
/// but for `training.states`, and scores the takes left out. Errors: those of check_training;
/// repeats of one take only; an invalid range of states. Threads: workers. Real-time: no.
[[nodiscard]] Expected<StateSelection> select_states(std::span<const TrainingClip> clips,
                                                     std::span<const FigureRepeat> repeats,
                                                     const FigureTrainingOptions& training,
                                                     const StateSelectionOptions& options = {});

/// Sets peak and chosen from `part.tried` (not empty, by rising number of states).
void choose_states(PartSelection& part, double saturation);

}  // namespace raks::motion
