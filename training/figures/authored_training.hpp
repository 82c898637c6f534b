#pragma once

#include <array>
#include <cstdint>

#include "base/expected.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "training/figures/figure_trainer.hpp"

/// A written figure learnt as captured motion is: it is danced many times, each time a little
/// otherwise, and those repetitions go through the same training.
namespace raks::motion {

struct AuthoredTrainingOptions {
    int takes = 5;    ///< dances of several repetitions each, every one with its own noise
    int repeats = 5;  ///< repetitions of the figure, or of its pair of sides, in a take
    /// States of each part; 0: by the figure's length and its quickest movement (states_for).
    int states = 0;
    std::uint64_t seed = 1;
    FigureFeatures features = FigureFeatures::angles;
};

/// Noisy repetitions with the exact moments of their counts. Those of a mirrored figure are pairs:
/// the figure, then its other side.
struct AuthoredMaterial {
    std::vector<TrainingClip> clips;
    std::vector<FigureRepeat> repeats;
    int beats = 4;  ///< of one repetition
};
[[nodiscard]] AuthoredMaterial authored_material(const AuthoredDance& dance,
                                                 const AuthoredFigure& figure,
                                                 const Skeleton& skeleton,
                                                 const AuthoredTrainingOptions& options);

/// Four slices a beat, six where something moves once a beat or quicker, twelve where it does so
/// twice or more: a slice longer than half a wave has no wave in it.
[[nodiscard]] int states_for(const AuthoredFigure& figure) noexcept;

struct AuthoredTrainingResult {
    FigureModel model;                       ///< for the lead: an authored dance is danced alone
    std::array<double, 3> log_likelihood{};  ///< per sample, by Part
    std::size_t repeats = 0;
};

/// Of angles, learns head, upper chest and hands with the joints of captured figures. Numbers are
/// rounded to 3 to 5 digits, so that the file stays small. The same options give the same bits.
/// Errors: those of faults_in_motion and of train_figure.
/// Threads: workers. Real-time: no (a second).
[[nodiscard]] Expected<AuthoredTrainingResult> train_authored_figure(
    const AuthoredDance& dance,
    const AuthoredFigure& figure,
    const Skeleton& skeleton,
    const AuthoredTrainingOptions& options = {});

}  // namespace raks::motion
