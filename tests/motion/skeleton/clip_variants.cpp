#include "tests/motion/skeleton/clip_variants.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "motion/skeleton/body/bone_aims.hpp"
#include "motion/skeleton/body/up_finder.hpp"
#include "motion/skeleton/bvh.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

constexpr std::size_t kJoints = 22;
using Names = std::array<std::string_view, kJoints>;

// The joints of own_dance(), in order.
constexpr std::size_t kLeftArm = 7;
constexpr std::size_t kRightArm = 11;
constexpr std::size_t kLeftUpLeg = 14;
constexpr std::size_t kRightUpLeg = 18;

struct Scheme {
    std::string_view name;
    // Trunk from the hips to the head; shoulder, arm, forearm and hand; thigh, shin, foot and toes:
    // "*" stands for the side.
    std::array<std::string_view, 14> joints;
    std::array<std::string_view, 2> sides;
};

constexpr std::array<Scheme, 12> kSchemes = {{
    {"cmu",
     {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "*Shoulder", "*Arm", "*ForeArm", "*Hand",
      "*UpLeg", "*Leg", "*Foot", "*ToeBase"},
     {"Left", "Right"}},
    {"mixamo",
     {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2", "mixamorig:Neck",
      "mixamorig:Head", "mixamorig:*Shoulder", "mixamorig:*Arm", "mixamorig:*ForeArm",
      "mixamorig:*Hand", "mixamorig:*UpLeg", "mixamorig:*Leg", "mixamorig:*Foot",
      "mixamorig:*ToeBase"},
     {"Left", "Right"}},
    {"xsens",
     {"Hips", "Chest", "Chest2", "Chest4", "Neck", "Head", "*Collar", "*Shoulder", "*Elbow",
      "*Wrist", "*Hip", "*Knee", "*Ankle", "*Toe"},
     {"Left", "Right"}},
    {"smpl",
     {"pelvis", "spine1", "spine2", "spine3", "neck", "head", "*_collar", "*_shoulder", "*_elbow",
      "*_wrist", "*_hip", "*_knee", "*_ankle", "*_foot"},
     {"left", "right"}},
    {"rokoko",
     {"Hips", "Spine1", "Spine2", "Spine3", "Neck", "Head", "*Shoulder", "*Arm", "*ForeArm", "*Hand",
      "*Thigh", "*Shin", "*Foot", "*Toe"},
     {"Left", "Right"}},
    {"vroid",
     {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest", "J_Bip_C_Neck",
      "J_Bip_C_Head", "J_Bip_*_Shoulder", "J_Bip_*_UpperArm", "J_Bip_*_LowerArm", "J_Bip_*_Hand",
      "J_Bip_*_UpperLeg", "J_Bip_*_LowerLeg", "J_Bip_*_Foot", "J_Bip_*_ToeBase"},
     {"L", "R"}},
    {"vrm",
     {"hips", "spine", "chest", "upperChest", "neck", "head", "*Shoulder", "*UpperArm", "*LowerArm",
      "*Hand", "*UpperLeg", "*LowerLeg", "*Foot", "*Toes"},
     {"left", "right"}},
    {"unreal",
     {"pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head", "clavicle_*", "upperarm_*",
      "lowerarm_*", "hand_*", "thigh_*", "calf_*", "foot_*", "ball_*"},
     {"l", "r"}},
    {"biped",
     {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2", "Bip01 Neck", "Bip01 Head",
      "Bip01 * Clavicle", "Bip01 * UpperArm", "Bip01 * Forearm", "Bip01 * Hand", "Bip01 * Thigh",
      "Bip01 * Calf", "Bip01 * Foot", "Bip01 * Toe0"},
     {"L", "R"}},
    {"daz",
     {"hip", "abdomen", "abdomen2", "chest", "neck", "head", "*Collar", "*Shldr", "*ForeArm",
      "*Hand", "*Thigh", "*Shin", "*Foot", "*Toe"},
     {"l", "r"}},
    {"bandai",
     {"Hips", "Spine", "Spine2", "Chest", "Neck", "Head", "Shoulder_*", "UpperArm_*", "LowerArm_*",
      "Hand_*", "UpperLeg_*", "LowerLeg_*", "Foot_*", "Toes_*"},
     {"L", "R"}},
    {"blender",
     {"hips", "spine", "spine.001", "spine.002", "neck", "head", "shoulder.*", "upper_arm.*",
      "forearm.*", "hand.*", "thigh.*", "shin.*", "foot.*", "toe.*"},
     {"L", "R"}},
}};

std::string on_side(std::string_view name, std::string_view side) {
    const std::size_t at = name.find('*');
    return std::string(name.substr(0, at)) + std::string(side) + std::string(name.substr(at + 1));
}

/// Rotation of a joint in the world at the first frame.
glm::dquat first_rotation(const MotionClip& clip, std::size_t joint) {
    return world_pose(clip, 0).rotations[joint];
}

/// Turns the frames of a joint and of all below it.
void turn_below(const MotionClip& clip,
                std::size_t top,
                const glm::dquat& turn,
                std::vector<glm::dquat>& frames) {
    std::vector<bool> is_below(clip.joints.size(), false);
    for (std::size_t j = top; j < clip.joints.size(); ++j) {
        is_below[j] = j == top || is_below[clip.joints[j].parent];
        if (is_below[j]) {
            frames[j] = turn;
        }
    }
}

/// Arms that many degrees down.
void lower_arms(const MotionClip& clip, double degrees, std::vector<glm::dquat>& frames) {
    const glm::dvec3 z(0.0, 0.0, 1.0);
    turn_below(clip, kLeftArm, glm::angleAxis(glm::radians(degrees), z), frames);
    turn_below(clip, kRightArm, glm::angleAxis(glm::radians(-degrees), z), frames);
}

/// Bones along +x: the shortest turn from there to where they are; the hips keep their frame.
void lay_along_x(const MotionClip& clip, std::vector<glm::dquat>& frames) {
    std::vector<bool> is_done(clip.joints.size(), false);
    is_done[0] = true;
    const auto lay = [&](std::size_t joint, const glm::dvec3& bone) {
        if (!is_done[joint] && glm::length(bone) > 0.0) {
            frames[joint] = shortest_turn({1.0, 0.0, 0.0}, glm::normalize(bone));
            is_done[joint] = true;
        }
    };
    for (std::size_t j = 1; j < clip.joints.size(); ++j) {
        lay(clip.joints[j].parent, clip.joints[j].offset);
        lay(j, clip.joints[j].end_site.value_or(glm::dvec3(0.0)));
    }
}

}  // namespace

std::string_view name_of(NameScheme scheme) {
    return kSchemes[static_cast<std::size_t>(scheme)].name;
}

std::string_view name_of(RestVariant rest) {
    constexpr std::array<std::string_view, 7> kNames = {"T-pose",
                                                        "A-pose 30",
                                                        "A-pose 45",
                                                        "N-pose",
                                                        "sitting",
                                                        "along x",
                                                        "first frame"};
    return kNames[static_cast<std::size_t>(rest)];
}

MotionClip own_dance() {
    const std::filesystem::path path = std::filesystem::path(RAKS_SOURCE_DIR) / "tests" / "data" /
                                       "bvh" / "dance" / "own_dance.bvh";
    return read_bvh(path).value();
}

MotionClip renamed(MotionClip clip, NameScheme scheme) {
    const Scheme& names = kSchemes[static_cast<std::size_t>(scheme)];
    for (std::size_t j = 0; j < 6; ++j) {
        clip.joints[j].name = names.joints[j];
    }
    for (std::size_t j = 0; j < 4; ++j) {
        clip.joints[6 + j].name = on_side(names.joints[6 + j], names.sides[0]);
        clip.joints[10 + j].name = on_side(names.joints[6 + j], names.sides[1]);
        clip.joints[kLeftUpLeg + j].name = on_side(names.joints[10 + j], names.sides[0]);
        clip.joints[kRightUpLeg + j].name = on_side(names.joints[10 + j], names.sides[1]);
    }
    return clip;
}

MotionClip with_frames(MotionClip clip, const std::vector<glm::dquat>& frames) {
    const std::size_t joints = clip.joints.size();
    for (std::size_t j = 0; j < joints; ++j) {
        ClipJoint& joint = clip.joints[j];
        const glm::dquat above = joint.parent == j ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                                   : glm::conjugate(frames[joint.parent]);
        joint.offset = above * joint.offset;
        if (joint.end_site) {
            joint.end_site = glm::conjugate(frames[j]) * *joint.end_site;
        }
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            const std::size_t at = frame * joints + j;
            clip.positions[at] = above * clip.positions[at];
            clip.rotations[at] = above * clip.rotations[at] * frames[j];
        }
    }
    return clip;
}

MotionClip with_rest(MotionClip clip, RestVariant rest) {
    std::vector<glm::dquat> frames(clip.joints.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    switch (rest) {
        case RestVariant::t_pose:
            return clip;
        case RestVariant::a_pose_30:
            lower_arms(clip, 30.0, frames);
            break;
        case RestVariant::a_pose_45:
            lower_arms(clip, 45.0, frames);
            break;
        case RestVariant::n_pose:
            lower_arms(clip, 90.0, frames);
            break;
        case RestVariant::sitting: {
            lower_arms(clip, 80.0, frames);
            const glm::dvec3 x(1.0, 0.0, 0.0);
            frames[kLeftUpLeg] = frames[kRightUpLeg] = glm::angleAxis(glm::radians(90.0), x);
            break;
        }
        case RestVariant::along_x:
            lay_along_x(clip, frames);
            break;
        case RestVariant::first_frame:
            for (std::size_t j = 0; j < frames.size(); ++j) {
                frames[j] = glm::conjugate(first_rotation(clip, j));
            }
            break;
    }
    return with_frames(std::move(clip), frames);
}

MotionClip with_up(MotionClip clip, const glm::dvec3& up, UpStyle style) {
    const glm::dquat turn = glm::conjugate(turn_to_y(up));
    if (style == UpStyle::whole_file) {
        clip = with_frames(std::move(clip),
                           std::vector<glm::dquat>(clip.joints.size(), glm::conjugate(turn)));
    }
    const std::size_t joints = clip.joints.size();
    clip.joints[0].offset = turn * clip.joints[0].offset;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        clip.positions[frame * joints] = turn * clip.positions[frame * joints];
        clip.rotations[frame * joints] = turn * clip.rotations[frame * joints];
    }
    return clip;
}

MotionClip in_unit(MotionClip clip, double metres) {
    const double factor = 0.01 / metres;
    for (ClipJoint& joint : clip.joints) {
        joint.offset *= factor;
        if (joint.end_site) {
            joint.end_site = *joint.end_site * factor;
        }
    }
    for (glm::dvec3& position : clip.positions) {
        position *= factor;
    }
    return clip;
}

}  // namespace raks::motion
