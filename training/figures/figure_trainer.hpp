#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/figures/motion_features.hpp"
#include "motion/figures/source_body.hpp"
#include "motion/skeleton/humanoid_mapping.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "training/figures/state_learning.hpp"

/// Learning one figure from its repetitions (Ofli 2008, section 4.1, with the states aligned to
/// the beat).
namespace raks::motion {

/// Motion to learn from, in metres of the source body over a floor at y = 0.
struct TrainingClip {
    std::string name;
    double frames_per_second = 60.0;
    std::vector<Pose> poses;
    std::vector<std::array<SourceFoot, 2>> feet;  ///< as many as poses
    double hips_height = 1.0;                     ///< over the soles at rest; metres
    std::vector<FrameSpan> faults;                ///< to be bridged
};

/// One repetition of the figure.
struct FigureRepeat {
    std::size_t clip = 0;
    /// Frame of every beat, the end included: beats + 1 numbers, rising; [0] is count 1.
    std::vector<double> beat_frames;
    double weight = 1.0;  ///< > 0
};

struct FigureTrainingOptions {
    std::string name;
    std::string dance;
    DanceRole role = DanceRole::lead;
    std::string attribution;
    FigureFeatures features = FigureFeatures::angles;
    int beats = 8;
    int samples_per_beat = 24;
    int states = 16;  ///< of each part; on unseen takes legs gain 0.2 a sample from 14 to 16
    /// Rounds of Baum-Welch after the alignment by counts. 0 keeps each state on its slice of the
    /// phase, which is what the dancer needs: free state boundaries differ between the parts, and
    /// the feet slide (4.1 cm against 2.3 cm a contact). It also tells more about unseen takes
    /// (16 states, one take left out, nats a sample, 0 against 6 rounds: torso 13.9, 12.2; upper
    /// 58.7, 57.7; lower 35.2, 35.2 of the lead; 18.8, 18.6; 55.9, 55.4; 30.6, 30.5 follow).
    int baum_welch_iterations = 0;
    double covariance_floor = 0.1;  ///< StateLearning
    CovarianceKind covariance = CovarianceKind::tied;
    StatesStart start = StatesStart::flat;
    double low_pass_hz = 10.0;  ///< of the captured motion before anything else
    /// By Part: learnt besides the default joints.
    std::array<std::vector<Bone>, 3> more_joints;

    /// Of each part's HMM.
    [[nodiscard]] StateLearning learning() const noexcept {
        return {states, baum_welch_iterations, covariance_floor, covariance, start};
    }
};

struct FigureTrainingResult {
    FigureModel model;
    /// Mean log-likelihood per sample of the training repeats, by Part (0 for one it has not).
    std::array<double, 3> log_likelihood{};
};

/// Everything that training relies on. Errors: no repeats; a repeat outside its clip, with beats
/// that do not rise, or under 4 frames a beat; motion that is not finite or beyond 1 km; options
/// out of range.
[[nodiscard]] Expected<void> check_training(std::span<const TrainingClip> clips,
                                            std::span<const FigureRepeat> repeats,
                                            const FigureTrainingOptions& options);

/// Errors: those of check_training.
[[nodiscard]] Expected<FigureTrainingResult> train_figure(std::span<const TrainingClip> clips,
                                                          std::span<const FigureRepeat> repeats,
                                                          const FigureTrainingOptions& options);

/// The poses of a repeat on the figure's phase axis, from one sample before count 1 to two after
/// the end (samples + 3 poses): what deltas and velocities at the ends need.
[[nodiscard]] std::vector<Pose> poses_on_phase(std::span<const Pose> poses,
                                               std::span<const double> beat_frames,
                                               int samples_per_beat);

/// Mean log-likelihood per sample of repeats under one part of a model: how well an unseen
/// repetition fits.
[[nodiscard]] Expected<double> score_repeats(const FigureModel& model,
                                             Part part,
                                             std::span<const TrainingClip> clips,
                                             std::span<const FigureRepeat> repeats,
                                             double low_pass_hz);

}  // namespace raks::motion
