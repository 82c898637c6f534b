#include "motion/skeleton/humanoid_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"

namespace raks::motion {
namespace {

struct Name {
    Bone bone;
    // Left side, lower case, separated by blanks; the first one found counts
    std::string_view names;
};

/// Names of the trunk's and left side's bones in the known schemes: DAZ/Poser, CMU/MotionBuilder,
/// Mixamo, Bandai Namco, VRM.
constexpr std::array<Name, 26> kNames = {{
    {Bone::hips, "hip hips pelvis"},
    {Bone::spine, "abdomen lowerback spine"},
    {Bone::chest, "chest spine1"},
    {Bone::upper_chest, "upperchest spine2"},
    {Bone::neck, "neck neck1"},
    {Bone::head, "head"},
    {Bone::left_upper_leg, "lthigh leftupleg leftupperleg upperleg_l"},
    {Bone::left_lower_leg, "lshin leftleg leftlowerleg lowerleg_l"},
    {Bone::left_foot, "lfoot leftfoot foot_l"},
    {Bone::left_toes, "ltoe lefttoebase lefttoes toes_l"},
    {Bone::left_shoulder, "lcollar leftshoulder shoulder_l"},
    {Bone::left_upper_arm, "lshldr leftarm leftupperarm upperarm_l"},
    {Bone::left_lower_arm, "lforearm leftforearm leftlowerarm lowerarm_l"},
    {Bone::left_hand, "lhand lefthand hand_l"},
    {Bone::left_thumb_proximal, "lthumb1 lthumb lefthandthumb2 leftthumbproximal"},
    {Bone::left_thumb_distal, "lthumb2 lefthandthumb3 leftthumbdistal"},
    {Bone::left_index_proximal, "lindex1 lefthandindex1 leftindexproximal"},
    {Bone::left_index_intermediate, "lindex2 lefthandindex2 leftindexintermediate"},
    {Bone::left_middle_proximal, "lmid1 lefthandmiddle1 leftmiddleproximal"},
    {Bone::left_middle_intermediate, "lmid2 lefthandmiddle2 leftmiddleintermediate"},
    {Bone::left_ring_proximal, "lring1 lefthandring1 leftringproximal"},
    {Bone::left_ring_intermediate, "lring2 lefthandring2 leftringintermediate"},
    {Bone::left_little_proximal, "lpinky1 lefthandpinky1 leftlittleproximal"},
    {Bone::left_little_intermediate, "lpinky2 lefthandpinky2 leftlittleintermediate"},
    {Bone::left_index_distal, "leftindexdistal"},
    {Bone::left_middle_distal, "leftmiddledistal"},
}};

/// Lower case, without "prefix:".
std::string plain_name(const std::string& name) {
    const std::size_t colon = name.rfind(':');
    std::string plain = colon == std::string::npos ? name : name.substr(colon + 1);
    std::transform(plain.begin(), plain.end(), plain.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return plain;
}

/// "lthigh" -> "rthigh", "leftleg" -> "rightleg", "foot_l" -> "foot_r".
std::string right_name(std::string_view left) {
    if (left.size() > 2 && left.substr(left.size() - 2) == "_l") {
        return std::string(left.substr(0, left.size() - 1)) + "r";
    }
    if (left.substr(0, 4) == "left") {
        return "right" + std::string(left.substr(4));
    }
    return left.empty() ? std::string() : "r" + std::string(left.substr(1));
}

// The first joint whose name is one of `wanted`, translated to the side.
std::optional<std::size_t> find_joint(const std::vector<std::string>& names,
                                      std::string_view wanted,
                                      Side side,
                                      bool is_middle) {
    while (!wanted.empty()) {
        const std::size_t end = std::min(wanted.find(' '), wanted.size());
        const std::string_view left = wanted.substr(0, end);
        const std::string name =
            side == Side::left || is_middle ? std::string(left) : right_name(left);
        const auto at = std::find(names.begin(), names.end(), name);
        if (at != names.end()) {
            return static_cast<std::size_t>(at - names.begin());
        }
        wanted.remove_prefix(std::min(wanted.size(), end + 1));
    }
    return std::nullopt;
}

// Whether `ancestor` lies above `joint` in the clip.
bool is_ancestor(const MotionClip& clip, std::size_t ancestor, std::size_t joint) {
    while (clip.joints[joint].parent != joint) {
        joint = clip.joints[joint].parent;
        if (joint == ancestor) {
            return true;
        }
    }
    return false;
}

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
    std::vector<std::string> names;
    for (const ClipJoint& joint : clip.joints) {
        names.push_back(plain_name(joint.name));
    }
    HumanoidMapping mapping;
    for (const Name& name : kNames) {
        const bool is_middle = mirrored(name.bone) == name.bone;
        for (const Side side : kSides) {
            const Bone bone = on_side(name.bone, side);
            if (auto joint = find_joint(names, name.names, side, is_middle)) {
                // A joint moves one bone only, and must lie below the joint of the bone's parent.
                const auto parent = mapped_parent(mapping, bone);
                if (!parent || is_ancestor(clip, *mapping.joint(*parent), *joint)) {
                    mapping.joints[index_of(bone)] = joint;
                }
            }
        }
    }
    std::string missing;
    const auto need = [&](std::initializer_list<Bone> bones, const char* what) {
        const bool has_all = std::all_of(bones.begin(), bones.end(), [&](Bone bone) {
            return mapping.joint(bone) && mapping.joint(mirrored(bone));
        });
        if (!has_all) {
            missing += missing.empty() ? what : std::string(", ") + what;
        }
    };
    need({Bone::hips}, "hips");
    need({Bone::left_upper_leg, Bone::left_lower_leg, Bone::left_foot}, "legs");
    need({Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand}, "arms");
    if (!missing.empty()) {
        return fail("no humanoid: " + missing + " not found among " +
                    std::to_string(clip.joints.size()) + " joints");
    }
    return mapping;
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
