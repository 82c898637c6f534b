#pragma once

#include <span>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "training/figures/figure_trainer.hpp"

/// Brings repetitions of a figure onto one phase axis and extracts the features of a part.
namespace raks::motion {

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

}  // namespace raks::motion
