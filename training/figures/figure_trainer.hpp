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
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "training/figures/state_learning.hpp"

/// Learning one figure from its repetitions (Ofli 2008, section 4.1, with the states aligned to
/// the beat).
namespace raks::motion {

/// One motion recording, in metres of the source body over a floor at y = 0.
struct TrainingClip {
    std::string name;                             ///< the take, without a file extension
    double frames_per_second = 60.0;              ///< 1 to 10,000
    std::vector<Pose> poses;                      ///< one a frame
    std::vector<std::array<SourceFoot, 2>> feet;  ///< as many as poses
    double hips_height = 1.0;                     ///< over the soles at rest; metres
    std::vector<FrameSpan> faults;                ///< frames to interpolate over before training
};

/// One repetition of the figure within a clip.
struct FigureRepeat {
    std::size_t clip = 0;  ///< index among the clips
    /// Frame of every beat, the end included: beats + 1 numbers, rising; [0] is count 1.
    std::vector<double> beat_frames;
    double weight = 1.0;  ///< > 0; its share in every mean
};

inline constexpr int kMostFigureBeats = 64;  ///< as a figure's file has them

/// What is learnt and how; the first four go into the model as they are.
struct FigureTrainingOptions {
    std::string name;                                  ///< of the figure
    std::string dance;                                 ///< of the dance
    DanceRole role = DanceRole::lead;                  ///< whose motion it is
    std::string attribution;                           ///< credit that the data's licence asks for
    FigureFeatures features = FigureFeatures::angles;  ///< joint angles, or joint positions
    int beats = 8;              ///< of one repetition, up to kMostFigureBeats
    int samples_per_beat = 24;  ///< of the phase axis, 4 to 200
    int states = 16;  ///< of each part; held-out legs gain 0.2 nats a sample from 14 to 16
    /// Rounds of Baum-Welch after the alignment by counts. 0 keeps each state on its slice of the
    /// phase, as the dancer plays them: free state boundaries differ between the parts, and the
    /// feet slide (4.1 cm against 2.3 cm a contact). It also fits unseen takes better (16 states,
    /// one take left out, nats a sample, 0 against 6 rounds: torso 13.9, 12.2; upper 58.7, 57.7;
    /// lower 35.2, 35.2 of the lead; 18.8, 18.6; 55.9, 55.4; 30.6, 30.5 of the follow).
    int baum_welch_iterations = 0;
    double covariance_floor = 0.1;                     ///< as in StateLearning
    CovarianceKind covariance = CovarianceKind::tied;  ///< one for all states, or one each
    StatesStart start = StatesStart::flat;             ///< where the states lie before Baum-Welch
    double low_pass_hz = 10.0;                ///< cut-off applied to the captured motion first; Hz
    std::size_t contact_bins = kContactBins;  ///< over the figure, 1 to 64 a beat
    /// By Part: joints learnt besides the default ones.
    std::array<std::vector<Bone>, 3> more_joints;

    /// These options as they apply to one part's HMM.
    [[nodiscard]] StateLearning learning() const noexcept {
        return {states, baum_welch_iterations, covariance_floor, covariance, start};
    }
};

/// The learnt figure and its training log-likelihood.
struct FigureTrainingResult {
    FigureModel model;  ///< passes validate()
    /// Mean log-likelihood per sample of the training repeats, by Part; nats; 0 for a part that the
    /// features do not have.
    std::array<double, 3> log_likelihood{};
};

/// Checks everything that training relies on. Errors: no repeats; a repeat outside its clip, with
/// beats that do not rise, or under 4 frames a beat; motion that is not finite or beyond 1 km;
/// options out of range.
[[nodiscard]] Expected<void> check_training(std::span<const TrainingClip> clips,
                                            std::span<const FigureRepeat> repeats,
                                            const FigureTrainingOptions& options);

/// Trains all parts, net motion and feet. Deterministic. Errors: those of check_training, and of a
/// model that does not pass validate().
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureTrainingResult> train_figure(std::span<const TrainingClip> clips,
                                                          std::span<const FigureRepeat> repeats,
                                                          const FigureTrainingOptions& options);

/// The poses of a repeat on the figure's phase axis, from one sample before count 1 to two after
/// the end (samples + 3 poses): what deltas and velocities at the ends need.
[[nodiscard]] std::vector<Pose> poses_on_phase(std::span<const Pose> poses,
                                               std::span<const double> beat_frames,
                                               int samples_per_beat);

/// Mean log-likelihood per sample of repeats under one part of a model, nats: how well unseen
/// repetitions fit. Errors: no repeats, or one that check_training would refuse.
[[nodiscard]] Expected<double> score_repeats(const FigureModel& model,
                                             Part part,
                                             std::span<const TrainingClip> clips,
                                             std::span<const FigureRepeat> repeats,
                                             double low_pass_hz);

}  // namespace raks::motion
