#include "motion/skeleton/body/retarget.hpp"

#include <algorithm>
#include <utility>

#include "base/statistics.hpp"

namespace raks::motion {
namespace {

/// Product of the local rotations from just below `above` down to `joint`: helper joints between
/// two bones are folded in.
glm::dquat folded_rotation(const MotionClip& clip,
                           std::size_t frame,
                           std::optional<std::size_t> above,
                           std::size_t joint) {
    glm::dquat rotation = clip.rotation(frame, joint);
    while (clip.joints[joint].parent != joint && clip.joints[joint].parent != above) {
        joint = clip.joints[joint].parent;
        rotation = clip.rotation(frame, joint) * rotation;
    }
    return rotation;
}

// One frame on the humanoid; bones that the clip lacks stay at rest.
Pose pose_of(const MotionClip& clip,
             const HumanoidMapping& mapping,
             std::size_t frame,
             const glm::dvec3& hips) {
    Pose pose;
    pose.hips_position = glm::vec3(hips);
    for (int i = 0; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        const auto joint = mapping.joint(bone);
        if (!joint) {
            continue;
        }
        std::optional<std::size_t> above;
        if (const auto parent = mapped_parent(mapping, bone)) {
            above = mapping.joint(*parent);
        }
        pose.rotation(bone) =
            glm::normalize(glm::quat(glm::normalize(folded_rotation(clip, frame, above, *joint))));
    }
    return pose;
}

}  // namespace

Expected<RetargetedClip> retarget(const StandingClip& standing,
                                  const Skeleton& target,
                                  std::optional<double> floor_height) {
    const MotionClip& clip = standing.clip;
    const HumanoidMapping& mapping = standing.body.mapping();
    const std::vector<glm::dvec3> rest = rest_positions(clip);
    RetargetedClip result;
    result.frames_per_second = clip.frames_per_second;
    result.metres_per_unit = standing.body.size.metres_per_unit;
    const double unit = result.metres_per_unit;
    const std::size_t hips = *mapping.joint(Bone::hips);

    // Sizes come from the rest pose, which does not depend on the motion.
    const std::vector<glm::dquat> upright(clip.joints.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    const double rest_toe = std::min(toe_tip_of(clip, mapping, Side::left, rest, upright).y,
                                     toe_tip_of(clip, mapping, Side::right, rest, upright).y);
    result.source_hips_height = (rest[hips].y - rest_toe) * unit;
    if (!(result.source_hips_height > 0.05)) {
        return fail("its hips are not above its toes in the rest pose");
    }
    result.hips_scale = static_cast<double>(target.hips_height()) / result.source_hips_height;

    std::vector<glm::dvec3> hips_places;
    std::vector<double> toe_heights;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ClipWorldPose world = world_pose(clip, frame);
        hips_places.push_back(world.positions[hips] * unit);
        std::array<SourceFoot, 2>& feet = result.source_feet.emplace_back();
        for (const Side side : kSides) {
            SourceFoot& foot = feet[static_cast<std::size_t>(side)];
            foot.ankle = world.positions[*mapping.joint(on_side(Bone::left_foot, side))] * unit;
            foot.toe_tip = toe_tip_of(clip, mapping, side, world.positions, world.rotations) * unit;
            toe_heights.push_back(foot.toe_tip.y);
        }
    }
    constexpr double kFloorShare = 0.05;  // a foot is on the floor for far more than 5 % of a dance
    result.floor_height = floor_height.value_or(lower_percentile(toe_heights, kFloorShare));
    const glm::dvec3 floor(0.0, result.floor_height, 0.0);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        for (SourceFoot& foot : result.source_feet[frame]) {
            foot.ankle -= floor;
            foot.toe_tip -= floor;
        }
        result.poses.push_back(
            pose_of(clip, mapping, frame, (hips_places[frame] - floor) * result.hips_scale));
    }
    return result;
}

Expected<RetargetedClip> retarget(const MotionClip& clip,
                                  const Skeleton& target,
                                  const RetargetOptions& options) {
    const auto standing = stand(clip, options.body);
    if (!standing) {
        return fail(standing.error());
    }
    return retarget(*standing, target, options.floor_height);
}

}  // namespace raks::motion
