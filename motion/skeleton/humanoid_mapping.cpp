#include "motion/skeleton/humanoid_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"
#include "motion/skeleton/body/joint_finder.hpp"

namespace raks::motion {
namespace {

/// The nearest bone above `bone` that the clip has.
std::optional<Bone> mapped_parent(const HumanoidMapping& mapping, Bone bone) {
    while (bone != Bone::hips) {
        bone = static_cast<Bone>(kBoneParents[index_of(bone)]);
        if (mapping.joint(bone)) {
            return bone;
        }
    }
    return std::nullopt;
}

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

/// Tip of a foot in the world: end site of the toes or of the foot, or the joint itself.
glm::dvec3 toe_tip_of(const MotionClip& clip,
                      const HumanoidMapping& mapping,
                      Side side,
                      const std::vector<glm::dvec3>& positions,
                      const std::vector<glm::dquat>& rotations) {
    for (const Bone bone : {Bone::left_toes, Bone::left_foot}) {
        if (const auto joint = mapping.joint(on_side(bone, side))) {
            const auto& end = clip.joints[*joint].end_site;
            return end ? positions[*joint] + rotations[*joint] * *end : positions[*joint];
        }
    }
    return {};
}

// Radians; pi for a vector without length, so that it fails every check.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const double length = glm::length(a) * glm::length(b);
    return length > 1e-12 ? std::acos(std::clamp(glm::dot(a, b) / length, -1.0, 1.0)) : M_PI;
}

// Copying local rotations is right only between T-poses.
Expected<void> check_rest_pose(const HumanoidMapping& mapping,
                               const std::vector<glm::dvec3>& rest) {
    constexpr double kMostAway = 40.0 * M_PI / 180.0;
    for (const Side side : kSides) {
        const auto direction = [&](Bone from, Bone to) {
            return rest[*mapping.joint(on_side(to, side))] -
                   rest[*mapping.joint(on_side(from, side))];
        };
        if (angle_between(direction(Bone::left_upper_leg, Bone::left_foot), {0, -1, 0}) >
            kMostAway) {
            return fail("its rest pose is no T-pose: the legs do not point down");
        }
        const glm::dvec3 outward(side == Side::left ? 1.0 : -1.0, 0.0, 0.0);
        if (angle_between(direction(Bone::left_upper_arm, Bone::left_hand), outward) > kMostAway) {
            return fail("its rest pose is no T-pose: the arms do not point sideways");
        }
    }
    return {};
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

Expected<HumanoidMapping> map_humanoid(const MotionClip& clip) {
    const Expected<FoundJoints> found = find_joints(clip);
    if (!found) {
        return fail(found.error());
    }
    return found->mapping;
}

Expected<RetargetedClip> retarget(const MotionClip& clip,
                                  const Skeleton& target,
                                  const RetargetOptions& options) {
    if (clip.frame_count == 0) {
        return fail("has no frames");
    }
    const auto mapping = map_humanoid(clip);
    if (!mapping) {
        return fail(mapping.error());
    }
    const std::vector<glm::dvec3> rest = rest_positions(clip);
    if (auto checked = check_rest_pose(*mapping, rest); !checked) {
        return fail(checked.error());
    }
    RetargetedClip result;
    result.frames_per_second = clip.frames_per_second;
    result.metres_per_unit = options.metres_per_unit.value_or(guess_metres_per_unit(clip));
    const double unit = result.metres_per_unit;
    const std::size_t hips = *mapping->joint(Bone::hips);

    // Sizes come from the rest pose, which does not depend on the motion.
    const std::vector<glm::dquat> upright(clip.joints.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    const double rest_toe = std::min(toe_tip_of(clip, *mapping, Side::left, rest, upright).y,
                                     toe_tip_of(clip, *mapping, Side::right, rest, upright).y);
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
            foot.ankle = world.positions[*mapping->joint(on_side(Bone::left_foot, side))] * unit;
            foot.toe_tip =
                toe_tip_of(clip, *mapping, side, world.positions, world.rotations) * unit;
            toe_heights.push_back(foot.toe_tip.y);
        }
    }
    constexpr double kFloorShare = 0.05;  // a foot is on the floor for far more than 5 % of a dance
    result.floor_height = options.floor_height.value_or(lower_percentile(toe_heights, kFloorShare));
    const glm::dvec3 floor(0.0, result.floor_height, 0.0);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        for (SourceFoot& foot : result.source_feet[frame]) {
            foot.ankle -= floor;
            foot.toe_tip -= floor;
        }
        result.poses.push_back(
            pose_of(clip, *mapping, frame, (hips_places[frame] - floor) * result.hips_scale));
    }
    return result;
}

}  // namespace raks::motion
