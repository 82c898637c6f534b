// Body track: joints and feet of a moving body in the world.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// The 19 joints that dance metrics use: body and limbs, no fingers and toes.
inline constexpr std::array<Bone, 19> kBodyBones = {
    Bone::hips,
    Bone::spine,
    Bone::chest,
    Bone::neck,
    Bone::head,
    Bone::left_shoulder,
    Bone::left_upper_arm,
    Bone::left_lower_arm,
    Bone::left_hand,
    Bone::right_shoulder,
    Bone::right_upper_arm,
    Bone::right_lower_arm,
    Bone::right_hand,
    Bone::left_upper_leg,
    Bone::left_lower_leg,
    Bone::left_foot,
    Bone::right_upper_leg,
    Bone::right_lower_leg,
    Bone::right_foot,
};

/// Index of the hips in kBodyBones.
inline constexpr std::size_t kHips = 0;

/// Places of a moving body in the world, metres, y up: the input of all metrics, whether it was
/// captured or generated.
struct BodyTrack {
    double frames_per_second = 60.0;                                ///< of the frames below
    std::vector<std::array<glm::dvec3, kBodyBones.size()>> joints;  ///< by frame
    std::vector<std::array<SourceFoot, 2>> feet;                    ///< by frame and Side

    /// Number of frames.
    [[nodiscard]] std::size_t frames() const noexcept { return joints.size(); }
};

/// The track of poses on a skeleton. Threads: workers. Real-time: no.
[[nodiscard]] BodyTrack body_track(const Skeleton& skeleton,
                                   std::span<const Pose> poses,
                                   double frames_per_second);

/// The track of a recorded clip in its own skeleton. Errors: no humanoid, or one of the 19 joints
/// missing (named). Threads: workers. Real-time: no.
[[nodiscard]] Expected<BodyTrack> body_track(const MotionClip& clip, double metres_per_unit);

/// Poses resampled from `from` to `to` frames a second, by interpolation. Threads: any. Real-time:
/// no.
[[nodiscard]] std::vector<Pose> resampled(std::span<const Pose> poses, double from, double to);

// Place series: one point of the body by frame, and the filters of the metrics. Internal to this
// folder.

/// Places of one point by frame; metres, world.
using Places = std::vector<glm::dvec3>;

/// Binomial filter 1-4-6-4-1, ends repeated.
[[nodiscard]] Places smoothed(const Places& places);

/// Speed by frame: central differences, one-sided at the ends; m/s.
[[nodiscard]] std::vector<double> speeds(const Places& places, double frames_per_second);

/// Places of one of the 19 joints, by its index in kBodyBones.
[[nodiscard]] Places joint_places(const BodyTrack& track, std::size_t joint);
/// Places of a toe tip.
[[nodiscard]] Places toe_places(const BodyTrack& track, Side side);
/// Places of the point `from_ankle` metres from the ankle towards the toe tip, at most the tip.
[[nodiscard]] Places foot_places(const BodyTrack& track, Side side, double from_ankle);

}  // namespace raks::motion
