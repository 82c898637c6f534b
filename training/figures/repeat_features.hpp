#pragma once

#include <span>
#include <vector>

#include "models/gaussian_hmm.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"
#include "training/figures/figure_trainer.hpp"

/// Repetitions of a figure made comparable: on one phase axis, as features of one part.
namespace raks::motion {

/// Every repeat by poses_on_phase, after its clip's faults were bridged and its noise filtered.
[[nodiscard]] std::vector<std::vector<Pose>> phased_repeats(std::span<const TrainingClip> clips,
                                                            std::span<const FigureRepeat> repeats,
                                                            int samples_per_beat,
                                                            double low_pass_hz);

/// The default joints of a part, and `more`; of angles, with their mean rotations over all repeats.
[[nodiscard]] PartModel mean_joints(Part which,
                                    std::span<const std::vector<Pose>> repeats,
                                    std::span<const double> weights,
                                    FigureFeatures features = FigureFeatures::angles,
                                    std::span<const Bone> more = {});

/// Features of a phased repeat at samples 0 to T - 1: T x D.
[[nodiscard]] models::Frames part_frames(std::span<const Pose> phased,
                                         const PartModel& part,
                                         int samples_per_beat);

}  // namespace raks::motion
