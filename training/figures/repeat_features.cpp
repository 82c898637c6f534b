#include "training/figures/repeat_features.hpp"

#include "motion/figures/figure_hmm.hpp"

namespace raks::motion {

std::vector<std::vector<Pose>> phased_repeats(std::span<const TrainingClip> clips,
                                              std::span<const FigureRepeat> repeats,
                                              int samples_per_beat,
                                              double low_pass_hz) {
    // Each clip is conditioned once, however many repeats it has, and only if it has any.
    std::vector<std::vector<Pose>> conditioned(clips.size());
    std::vector<std::vector<Pose>> result;
    for (const FigureRepeat& repeat : repeats) {
        const TrainingClip& clip = clips[repeat.clip];
        std::vector<Pose>& poses = conditioned[repeat.clip];
        if (poses.empty()) {
            // Faults first: the filter would smear them over good frames.
            poses = clip.poses;
            bridge_faults(poses, clip.faults);
            poses = filtered(poses, low_pass_taps(low_pass_hz, clip.frames_per_second));
        }
        result.push_back(poses_on_phase(poses, repeat.beat_frames, samples_per_beat));
    }
    return result;
}

PartModel mean_joints(Part which,
                      std::span<const std::vector<Pose>> repeats,
                      std::span<const double> weights,
                      FigureFeatures features,
                      std::span<const Bone> more) {
    PartModel part;
    part.part = which;
    part.features = features;
    std::vector<Bone> bones = default_joints(which, features);
    bones.insert(bones.end(), more.begin(), more.end());
    for (const Bone bone : bones) {
        // Positions need no reference rotation.
        if (features == FigureFeatures::positions) {
            part.joints.push_back({bone});
            continue;
        }
        // All samples of all repeats, each with its repeat's weight.
        std::vector<glm::dquat> rotations;
        std::vector<double> each;
        for (std::size_t r = 0; r < repeats.size(); ++r) {
            for (const Pose& pose : repeats[r]) {
                rotations.emplace_back(pose.rotation(bone));
                each.push_back(weights[r]);
            }
        }
        part.joints.push_back({bone, mean_rotation(rotations, each)});
    }
    return part;
}

models::Frames part_frames(std::span<const Pose> phased,
                           const PartModel& part,
                           int samples_per_beat) {
    constexpr std::size_t kAround = 3;  // one sample before the figure, two after it
    const FeatureTrack track = features_of(phased, part, samples_per_beat);
    return frames_of(track, 1, phased.size() - kAround);
}

}  // namespace raks::motion
