#include "motion/skeleton/formats/mmd/mmd_clip.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "motion/skeleton/formats/mmd/mmd_morphs.hpp"
#include "motion/skeleton/formats/mmd/vmd.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

using B = MmdBone;

// The left bones of limbs whose turn is that of a bone of the standard body.
struct LimbRow {
    Bone bone;
    MmdBone mmd;
};
constexpr std::array<LimbRow, 22> kLimbRows = {{
    {Bone::left_upper_leg, B::left_leg_d},
    {Bone::left_lower_leg, B::left_knee_d},
    {Bone::left_foot, B::left_ankle_d},
    {Bone::left_shoulder, B::left_shoulder},
    {Bone::left_upper_arm, B::left_arm_twist},
    {Bone::left_lower_arm, B::left_wrist_twist},
    {Bone::left_hand, B::left_wrist},
    {Bone::left_thumb_metacarpal, B::left_thumb0},
    {Bone::left_thumb_proximal, B::left_thumb1},
    {Bone::left_thumb_distal, B::left_thumb2},
    {Bone::left_index_proximal, B::left_index1},
    {Bone::left_index_intermediate, B::left_index2},
    {Bone::left_index_distal, B::left_index3},
    {Bone::left_middle_proximal, B::left_middle1},
    {Bone::left_middle_intermediate, B::left_middle2},
    {Bone::left_middle_distal, B::left_middle3},
    {Bone::left_ring_proximal, B::left_ring1},
    {Bone::left_ring_intermediate, B::left_ring2},
    {Bone::left_ring_distal, B::left_ring3},
    {Bone::left_little_proximal, B::left_little1},
    {Bone::left_little_intermediate, B::left_little2},
    {Bone::left_little_distal, B::left_little3},
}};

// The joints at rest, from the body's own places there, arms stretched aside.
std::vector<ClipJoint> clip_joints() {
    // From a bone of the table to one above it.
    const auto way = [](MmdBone from, MmdBone to) {
        glm::dvec3 offset(0.0);
        for (MmdBone at = from; at != to; at = *mmd_bone_rows()[index_of(at)].parent) {
            offset += mmd_bone_rows()[index_of(at)].offset;
        }
        return offset;
    };
    std::array<glm::dvec3, kBoneCount> offsets{};
    const auto put = [&](Bone bone, const glm::dvec3& offset) { offsets[index_of(bone)] = offset; };
    const glm::dvec3 legs(0.0, way(B::left_leg, B::mother).y, 0.0);
    const glm::dvec3 hips = legs + glm::dvec3(0.0, kMmdHipsOverLegs, 0.0);
    const glm::dvec3 waist = way(B::upper_body, B::mother);
    const glm::dvec3 chest = way(B::upper_body2, B::upper_body);
    put(Bone::hips, hips);
    put(Bone::spine, waist - hips);
    put(Bone::chest, 0.5 * chest);
    put(Bone::upper_chest, 0.5 * chest);
    put(Bone::neck, way(B::neck, B::upper_body2));
    put(Bone::head, way(B::head, B::neck));
    const auto put_limb = [&](Bone left, const glm::dvec3& offset) {
        put(left, offset);
        put(mirrored(left), {-offset.x, offset.y, offset.z});
    };
    put_limb(Bone::left_upper_leg, way(B::left_leg, B::mother) - hips);
    put_limb(Bone::left_lower_leg, way(B::left_knee, B::left_leg));
    put_limb(Bone::left_foot, way(B::left_ankle, B::left_knee));
    put_limb(Bone::left_toes, way(B::left_toe, B::left_ankle));
    put_limb(Bone::left_shoulder, way(B::left_shoulder, B::upper_body2));
    put_limb(Bone::left_upper_arm, way(B::left_arm, B::left_shoulder));
    put_limb(Bone::left_lower_arm, way(B::left_elbow, B::left_arm));
    put_limb(Bone::left_hand, way(B::left_wrist, B::left_elbow));
    for (std::size_t i = 7; i < kLimbRows.size(); ++i) {
        const MmdBoneRow& row = mmd_bone_rows()[index_of(kLimbRows[i].mmd)];
        put_limb(kLimbRows[i].bone, row.offset);
    }
    std::vector<ClipJoint> joints;
    for (std::size_t bone = 0; bone < kBoneNames.size(); ++bone) {
        joints.push_back(
            {std::string(kBoneNames[bone]), kBoneParents[bone], offsets[bone], std::nullopt});
    }
    // Tips: the crown, and the toes' on the sole.
    joints[index_of(Bone::head)].end_site = glm::dvec3(0.0, 0.2, 0.02);
    for (const Side side : kSides) {
        joints[index_of(on_side(Bone::left_toes, side))].end_site = glm::dvec3(0.0, -0.0222, 0.065);
    }
    return joints;
}

}  // namespace

MmdHumanoid humanoid_of(const MmdBody& body, const MmdPose& pose, bool has_third) {
    const MmdWorld world = body.world(pose);
    MmdHumanoid humanoid;
    const auto turn = [&](Bone bone) -> glm::dquat& { return humanoid.turns[index_of(bone)]; };
    turn(Bone::hips) = world.turn(B::lower_body);
    const glm::dvec3 legs =
        0.5 * (world.place(B::left_leg) + world.place(on_side(B::left_leg, Side::right)));
    humanoid.hips = legs + turn(Bone::hips) * glm::dvec3(0.0, kMmdHipsOverLegs, 0.0);
    turn(Bone::spine) = world.turn(B::upper_body);
    turn(Bone::upper_chest) = world.turn(B::upper_body3);
    turn(Bone::chest) =
        has_third ? world.turn(B::upper_body2)
                  : glm::normalize(glm::slerp(turn(Bone::spine), turn(Bone::upper_chest), 0.5));
    turn(Bone::neck) = world.turn(B::neck);
    turn(Bone::head) = world.turn(B::head);
    for (const Side side : kSides) {
        for (const LimbRow& row : kLimbRows) {
            const MmdBone bone = on_side(row.mmd, side);
            turn(on_side(row.bone, side)) =
                is_of_arm(bone) ? world.turn(bone) * body.arm_at_rest(side) : world.turn(bone);
        }
        turn(on_side(Bone::left_toes, side)) = world.turn(on_side(B::left_toe_ex, side)) *
                                               pose.turns[index_of(on_side(B::left_toe, side))];
    }
    return humanoid;
}

Expected<MotionClip> mmd_clip(const MmdMotion& motion, double arm_angle) {
    if (!motion.has_body()) {
        return fail("holds no key of a body's bone");
    }
    const MmdBody body(arm_angle);
    const bool has_third = !motion.bones[index_of(B::upper_body3)].empty();
    MotionClip clip;
    clip.joints = clip_joints();
    clip.frames_per_second = kMmdRate;
    clip.frame_count = std::size_t{motion.last_frame()} + 1;
    clip.metres_per_unit = 1.0;
    clip.up = glm::dvec3(0.0, 1.0, 0.0);
    clip.rests_in_t_pose = true;
    clip.rotations.reserve(clip.frame_count * kBoneCount);
    clip.positions.reserve(clip.frame_count * kBoneCount);
    MmdSampler sampler(motion);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const MmdHumanoid humanoid =
            humanoid_of(body, sampler.pose_at(static_cast<std::uint32_t>(frame)), has_third);
        for (std::size_t bone = 0; bone < kBoneNames.size(); ++bone) {
            const glm::dquat& turn = humanoid.turns[bone];
            clip.rotations.push_back(
                bone == 0
                    ? turn
                    : glm::normalize(glm::conjugate(humanoid.turns[kBoneParents[bone]]) * turn));
            clip.positions.push_back(bone == 0 ? humanoid.hips : clip.joints[bone].offset);
        }
    }
    clip.expressions = mmd_expressions(motion, clip.frame_count);
    clip.warnings = motion.warnings;
    return clip;
}

Expected<MotionClip> parse_vmd(std::string_view bytes, std::string_view name, double arm_angle) {
    const std::string file(name);
    auto read = read_vmd(bytes);
    if (!read) {
        return fail(std::move(read.error()).in(file));
    }
    if (!read->motion.has_body() && !read->camera.empty()) {
        return fail(file + ": moves a camera, not a body; give it as --camera-motion");
    }
    const auto has_keys = [](const auto& keys) { return !keys.empty(); };
    if (!read->motion.has_body() &&
        std::any_of(read->motion.morphs.begin(), read->motion.morphs.end(), has_keys)) {
        return fail(file + ": moves a face alone, not a body");
    }
    auto clip = mmd_clip(read->motion, arm_angle);
    if (!clip) {
        std::string message = std::move(clip.error().message);
        for (const std::string& warning : read->motion.warnings) {
            message += "; " + warning;
        }
        return fail(file + ": " + message);
    }
    return clip;
}

}  // namespace raks::motion
