#include "tests/motion/skeleton/clip_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "motion/skeleton/body/bone_aims.hpp"
#include "motion/skeleton/body/up_finder.hpp"
#include "motion/skeleton/formats/bvh.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

// The joints of own_dance(), in order.
constexpr std::size_t kLeftArm = 7;
constexpr std::size_t kRightArm = 11;
constexpr std::size_t kLeftUpLeg = 14;
constexpr std::size_t kRightUpLeg = 18;

/// The bones of own_dance(), in order.
constexpr std::array<Bone, 22> kBones = {Bone::hips,
                                         Bone::spine,
                                         Bone::chest,
                                         Bone::upper_chest,
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
                                         Bone::left_toes,
                                         Bone::right_upper_leg,
                                         Bone::right_lower_leg,
                                         Bone::right_foot,
                                         Bone::right_toes};

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

std::string_view name_of(RestVariant rest) {
    constexpr std::array<std::string_view, 7> kNames = {
        "T-pose", "A-pose 30", "A-pose 45", "N-pose", "sitting", "along x", "first frame"};
    return kNames[static_cast<std::size_t>(rest)];
}

MotionClip own_dance() {
    const std::filesystem::path path = std::filesystem::path(RAKS_SOURCE_DIR) / "tests" / "data" /
                                       "bvh" / "dance" / "own_dance.bvh";
    return read_bvh(path).value();
}

MotionClip renamed(MotionClip clip, const body_test::NamingScheme& scheme) {
    const std::map<Bone, std::string> names = body_test::names_of(scheme);
    for (std::size_t j = 0; j < kBones.size(); ++j) {
        clip.joints[j].name = names.at(kBones[j]);
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

namespace {

/// Degrees about z, x and y, in this order, of a rotation.
glm::dvec3 zxy_degrees(const glm::dquat& rotation) {
    const glm::dmat3 m = glm::mat3_cast(glm::normalize(rotation));
    // m[column][row]: R = Rz Rx Ry.
    const double x = std::asin(std::clamp(m[1][2], -1.0, 1.0));
    return {glm::degrees(std::atan2(-m[1][0], m[1][1])),
            glm::degrees(x),
            glm::degrees(std::atan2(-m[0][2], m[2][2]))};
}

void add_joint(const MotionClip& clip, std::size_t joint, std::string& text) {
    const ClipJoint& at = clip.joints[joint];
    text += fmt::format("{} {}\n{{\nOFFSET {} {} {}\nCHANNELS {} Zrotation Xrotation Yrotation\n",
                        at.parent == joint ? "ROOT" : "JOINT",
                        at.name,
                        at.offset.x,
                        at.offset.y,
                        at.offset.z,
                        at.parent == joint ? "6 Xposition Yposition Zposition" : "3");
    for (std::size_t child = joint + 1; child < clip.joints.size(); ++child) {
        if (clip.joints[child].parent == joint) {
            add_joint(clip, child, text);
        }
    }
    if (at.end_site) {
        text += fmt::format(
            "End Site\n{{\nOFFSET {} {} {}\n}}\n", at.end_site->x, at.end_site->y, at.end_site->z);
    }
    text += "}\n";
}

}  // namespace

std::string bvh_text(const MotionClip& clip) {
    std::string text = "HIERARCHY\n";
    add_joint(clip, 0, text);
    text += fmt::format(
        "MOTION\nFrames: {}\nFrame Time: {}\n", clip.frame_count, 1.0 / clip.frames_per_second);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const glm::dvec3& place = clip.position(frame, 0);
        text += fmt::format("{} {} {}", place.x, place.y, place.z);
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            const glm::dvec3 angles = zxy_degrees(clip.rotation(frame, joint));
            text += fmt::format(" {} {} {}", angles.x, angles.y, angles.z);
        }
        text += "\n";
    }
    return text;
}

}  // namespace raks::motion
