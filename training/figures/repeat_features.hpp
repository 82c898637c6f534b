#pragma once

#include <span>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "training/figures/figure_trainer.hpp"

/// Brings repetitions of a figure onto one phase axis, extracts the features of a part, and tells
/// repetitions apart that turn otherwise.
namespace raks::motion {

/// Maps beats to frames and back: a smooth, rising curve through the given frames of beats 0, 1, 2,
/// ... by monotone cubic interpolation (Fritsch and Carlson 1980). A piecewise linear map would
/// give every joint's speed a step at each change of tempo. Linear beyond the ends.
/// Threads: any. Real-time: no.
class PhaseWarp {
 public:
    /// `beat_frames`: at least 2 frames, rising.
    explicit PhaseWarp(std::span<const double> beat_frames);

    /// Frame, with a fraction, of a beat; any real number.
    [[nodiscard]] double frame_at(double beat) const noexcept;
    /// The inverse of frame_at (by bisection, to 1e-9 beats); may lie beyond the ends.
    [[nodiscard]] double beat_at(double frame) const noexcept;

 private:
    std::vector<double> frames_;
    std::vector<double> slopes_;  // frames a beat, at each beat
};

/// poses_on_phase of every repeat, after faults in its clip are bridged and the motion low-passed.
[[nodiscard]] std::vector<std::vector<Pose>> phased_repeats(std::span<const TrainingClip> clips,
                                                            std::span<const FigureRepeat> repeats,
                                                            int samples_per_beat,
                                                            double low_pass_hz);

/// A part without states: its default joints and those in `more`; for angles with the mean rotation
/// of each joint over all repeats.
[[nodiscard]] PartModel mean_joints(Part which,
                                    std::span<const std::vector<Pose>> repeats,
                                    std::span<const double> weights,
                                    FigureFeatures features = FigureFeatures::angles,
                                    std::span<const Bone> more = {});

/// Features of a phased repeat (from poses_on_phase) at samples 0 to T - 1: T x D.
[[nodiscard]] models::Frames part_frames(std::span<const Pose> phased,
                                         const PartModel& part,
                                         int samples_per_beat);

/// How far the hips turn over a repeat, radians: positive from +z to +x, full turns counted.
[[nodiscard]] double turn_of(const TrainingClip& clip, const FigureRepeat& repeat);

/// Takes that share a label may turn to either side, or half a turn more or less; their mean would
/// match none of them. Keeps the repeats whose turn lies within 90 degrees of the commonest turn
/// (the one with most others within 60 degrees; the first of equals). One flag a repeat: is it
/// kept?
/// Threads: workers. Real-time: no.
[[nodiscard]] std::vector<bool> of_common_turn(const std::vector<TrainingClip>& clips,
                                               const std::vector<FigureRepeat>& repeats);

}  // namespace raks::motion
