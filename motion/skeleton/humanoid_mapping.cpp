#include "motion/skeleton/humanoid_mapping.hpp"

#include <algorithm>
#include <utility>

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

}  // namespace

std::optional<Bone> mapped_parent(const HumanoidMapping& mapping, Bone bone) {
    while (bone != Bone::hips) {
        bone = static_cast<Bone>(kBoneParents[index_of(bone)]);
        if (mapping.joint(bone)) {
            return bone;
        }
    }
    return std::nullopt;
}

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

}  // namespace raks::motion
