#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"
#include "training/hmm/hmm_training.hpp"

namespace raks::motion {

/// How frames are assigned to the states of an HMM before Baum-Welch.
enum class StatesStart : std::uint8_t {
    flat,       ///< equal slices of the sequences
    segmental,  ///< from there by segmental k-means along Viterbi paths
};
/// By StatesStart.
inline constexpr std::array<std::string_view, 2> kStatesStartNames = {"flat", "segmental"};

/// How the HMM of one part is learnt.
struct StateLearning {
    int states = 16;     ///< N, >= 1
    int iterations = 0;  ///< of Baum-Welch, after the start
    /// Share of each feature's variance that is the least of every variance (diagonal), or is added
    /// to the diagonal of every covariance (full, tied).
    double covariance_floor = 0.1;
    CovarianceKind covariance = CovarianceKind::tied;  ///< one for all states, or one each
    StatesStart start = StatesStart::flat;             ///< before Baum-Welch
};

/// Trains a left-to-right HMM. Errors: no sequence of at least as many frames as states.
[[nodiscard]] Expected<models::TrainingResult> learn_states(const models::TrainingSet& set,
                                                            const StateLearning& learning);

/// The most likely states of every sequence, and the tied covariance about their means.
struct FollowedStates {
    std::vector<std::vector<std::size_t>> paths;  ///< Viterbi; of each sequence
    Eigen::MatrixXd tied;                         ///< D x D, with the floor on its diagonal
};
/// Viterbi paths of all sequences under `hmm`. Errors: an invalid model or set.
[[nodiscard]] Expected<FollowedStates> follow_states(const models::GaussianHmm& hmm,
                                                     const models::TrainingSet& set,
                                                     double covariance_floor);

}  // namespace raks::motion
