#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/figures/figure_trainer.hpp"

/// How many states a part needs: by what the model says of takes that it has not seen (Ofli 2008,
/// section 4.1).
namespace raks::motion {

struct StateSelectionOptions {
    int fewest = 2;   ///< as in the paper
    int most = 19;    ///< as in the paper; at most one a sample
    int threads = 1;  ///< any number gives the same bits
    /// Takes are left out one by one, or in so many groups when there are more.
    std::size_t most_folds = 7;
    /// Saturation: the fewest states whose held-out log-likelihood lacks at most this share of what
    /// is gained from the worst number of states up to the peak. Log-likelihoods have no zero of
    /// their own (they move with the units), so the share is one of the gain.
    double saturation = 0.05;
};

/// Mean log-likelihoods a sample, in nats, over the folds' repeats.
struct StatesTried {
    int states = 0;
    double training = 0.0;
    double held_out = 0.0;
};

struct PartSelection {
    std::vector<StatesTried> tried;  ///< by rising number of states
    int peak = 0;                    ///< states with the highest held-out value; ties: the fewest
    int chosen = 0;                  ///< by saturation; never more than the peak
};

struct StateSelection {
    std::vector<std::vector<std::string>> folds;  ///< the takes left out together
    std::array<PartSelection, 3> parts;           ///< by Part; empty: not of these features
};

/// Trains every part of the features with every number of states on every fold: left to right, one
/// tied covariance, options.training.baum_welch_iterations rounds; `training.states` does not
/// matter. Errors: those of check_training; repeats of one take only; a range of states that is
/// none.
[[nodiscard]] Expected<StateSelection> select_states(std::span<const TrainingClip> clips,
                                                     std::span<const FigureRepeat> repeats,
                                                     const FigureTrainingOptions& training,
                                                     const StateSelectionOptions& options = {});

/// The peak and the choice among what was tried (not empty).
void choose_states(PartSelection& part, double saturation);

}  // namespace raks::motion
