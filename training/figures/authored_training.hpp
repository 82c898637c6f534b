#pragma once

#include <array>
#include <cstdint>

#include "base/expected.hpp"
#include "motion/choreography/authored_dance.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "training/figures/figure_trainer.hpp"

/// Learns a written figure in the same way as captured motion: the figure is evaluated many times
/// with small random variations, and those repetitions are the training data.
namespace raks::motion {

/// How many noisy repetitions are made of a written figure, and what is learnt from them.
struct AuthoredTrainingOptions {
    int takes = 5;    ///< evaluations of several repetitions each; every one has its own noise
    int repeats = 5;  ///< repetitions of the figure, or of its pair of sides, in a take
    /// States of each part; 0: by the figure's length and its quickest movement (states_for).
    int states = 0;
    std::uint64_t seed = 1;  ///< of the noise; the same seed gives the same bits
    FigureFeatures features = FigureFeatures::angles;  ///< joint angles, or joint positions
    /// Whose part the figure is: a follow's is made from the lead's first (follow_of).
    DanceRole role = DanceRole::lead;
};

/// Noisy repetitions of a written figure with the exact frame of every beat. A repetition of a
/// mirrored figure is a pair: the figure, then its other side.
struct AuthoredMaterial {
    std::vector<TrainingClip> clips;    ///< one a take, at 120 frames a second
    std::vector<FigureRepeat> repeats;  ///< of all clips, equal weights
    int beats = 4;                      ///< of one repetition
};
/// Evaluates the figure options.takes times. Threads: any. Real-time: no.
[[nodiscard]] AuthoredMaterial authored_material(const AuthoredDance& dance,
                                                 const AuthoredFigure& figure,
                                                 const Skeleton& skeleton,
                                                 const AuthoredTrainingOptions& options);

/// States of each part, 8 to 64: four a beat, six where something moves with a period of a beat or
/// less, twelve where the period is half a beat or less. A state longer than half a wave averages
/// the wave away.
[[nodiscard]] int states_for(const AuthoredFigure& figure) noexcept;

/// The learnt figure and how well it fits its own training data.
struct AuthoredTrainingResult {
    FigureModel model;                       ///< of the options' role
    std::array<double, 3> log_likelihood{};  ///< per sample, by Part
    std::size_t repeats = 0;                 ///< repetitions that were learnt from
};

/// Figures of angles also learn upper chest, head and hands, which captured figures leave out.
/// Numbers are rounded to 3 to 5 digits to keep the file small. The same options give the same
/// bits.
/// Errors: those of faults_in_motion and of train_figure.
/// Threads: workers. Real-time: no (a second).
[[nodiscard]] Expected<AuthoredTrainingResult> train_authored_figure(
    const AuthoredDance& dance,
    const AuthoredFigure& figure,
    const Skeleton& skeleton,
    const AuthoredTrainingOptions& options = {});

}  // namespace raks::motion
