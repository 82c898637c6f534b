// Humanoid mapping: recorded skeletons to the humanoid, and retargeting.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

/// Which joint of a clip moves which humanoid bone. Joints without a bone (helpers like lButtock
/// or LHipJoint) are folded into the next bone below them.
struct HumanoidMapping {
    std::array<std::optional<std::size_t>, kBoneCount> joints{};  ///< by bone

    /// The joint of a bone; none: the clip has none.
    [[nodiscard]] std::optional<std::size_t> joint(Bone bone) const noexcept {
        return joints[index_of(bone)];
    }
};

/// The mapping that find_joints (body/joint_finder.hpp) finds. Errors: those of find_joints.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<HumanoidMapping> map_humanoid(const MotionClip& clip);

/// What retarget() cannot know from the clip alone.
struct RetargetOptions {
    /// Metres per file unit; none: guess_metres_per_unit(). (CMU takes 60_xx: 1.267, 61_xx: 1.17.)
    std::optional<double> metres_per_unit;
    /// Height of the source's floor in metres; none: the 5th percentile of both toe tips' height.
    std::optional<double> floor_height;
};

/// A foot of the source at one frame, metres, over the source's floor (y = 0), not scaled to the
/// target's size: contacts and landings are measured on it.
struct SourceFoot {
    glm::dvec3 ankle{};    ///< the ankle's joint
    glm::dvec3 toe_tip{};  ///< end site of foot or toes; the joint itself where there is none
};

/// A clip on the target skeleton, one pose a frame.
struct RetargetedClip {
    double frames_per_second = 0.0;  ///< of the clip
    std::vector<Pose> poses;  ///< hips scaled by hips_scale and over a floor at y = 0; no contacts
    std::vector<std::array<SourceFoot, 2>> source_feet;  ///< by frame and Side
    double metres_per_unit = 1.0;                        ///< that was used
    double floor_height = 0.0;        ///< of the source, metres; subtracted from all heights
    double source_hips_height = 0.0;  ///< hips over the toe tips in the source's rest pose, metres
    double hips_scale = 1.0;          ///< target's hips height / source's
};

/// Retargets a clip to `target`. Both rest poses are T-poses, so local rotations are copied; those
/// of helper joints are composed into the bone below. Errors: those of map_humanoid, and a rest
/// pose whose legs do not point down or whose arms do not point sideways (within 40 degrees).
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<RetargetedClip> retarget(const MotionClip& clip,
                                                const Skeleton& target,
                                                const RetargetOptions& options = {});

}  // namespace raks::motion
