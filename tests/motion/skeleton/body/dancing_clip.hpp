// A clip of a body that moves a little, whose joints are known, under any names.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "motion/skeleton/humanoid.hpp"
#include "motion/skeleton/motion_clip.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion::body_test {

/// What stands between the bones of a DancingClip.
struct Extras {
    bool fingers = false;  ///< three joints of an index and a thumb on each hand
    bool helpers = false;  ///< sockets over the thighs, twist joints on and in limbs, end joints
    bool feet = true;      ///< ankles have toes
    bool arms = true;      ///< and a head
    bool root = false;     ///< hips travel about the world below a root that stays
    double turned = 1.0;   ///< -1: a mirrored body, whose left lies on its right
};

/// Centimetres, y up, facing +z, T-pose at rest; 24 frames of steps, bent knees and elbows.
struct DancingClip {
    MotionClip clip;
    std::map<Bone, std::size_t> joints;  ///< where each bone is

    explicit DancingClip(const Extras& extras = {}) {
        clip.frames_per_second = 30.0;
        clip.frame_count = 24;
        if (extras.root) {
            add("root", 0, {0, 0, 0});
        }
        const std::size_t hips = add(Bone::hips, 0, {0, 93, 0});
        if (extras.arms) {
            add_trunk(hips, extras);
        }
        for (const Side side : kSides) {
            add_leg(hips, side, extras);
        }
        dance();
    }

    /// Names the bones; joints that are no bone keep theirs.
    void rename(const std::map<Bone, std::string>& names) {
        for (const auto& [bone, name] : names) {
            if (joints.contains(bone)) {
                clip.joints[joints[bone]].name = name;
            }
        }
    }
    /// The joints under names that say nothing, in an order that says nothing.
    void forget_names() {
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            clip.joints[joint].name = "joint_" + std::to_string(joint * 37 % 101);
        }
    }

 private:
    std::size_t add(const std::string& name, std::size_t parent, const glm::dvec3& offset) {
        const bool is_root = clip.joints.empty();
        clip.joints.push_back(
            {.name = name, .parent = is_root ? 0 : parent, .offset = offset, .end_site = {}});
        return clip.joints.size() - 1;
    }
    std::size_t add(Bone bone, std::size_t parent, const glm::dvec3& offset) {
        return joints[bone] = add(std::string(kBoneNames[index_of(bone)]), parent, offset);
    }

    void add_trunk(std::size_t hips, const Extras& extras) {
        const std::size_t spine = add(Bone::spine, hips, {0, 8.5, -0.8});
        const std::size_t chest = add(Bone::chest, spine, {0, 10, -1});
        const std::size_t upper = add(Bone::upper_chest, chest, {0, 11.5, -0.6});
        for (const Side side : kSides) {
            add_arm(upper, side, extras);
        }
        const std::size_t neck = add(Bone::neck, upper, {0, 17.5, -0.6});
        const std::size_t head = add(Bone::head, neck, {0, 8.5, 1.8});
        clip.joints[head].end_site = glm::dvec3(0, 15, 0);
    }

    void add_arm(std::size_t chest, Side side, const Extras& extras) {
        const double out = side == Side::left ? extras.turned : -extras.turned;
        const auto bone = [&](Bone left) { return on_side(left, side); };
        std::size_t at = add(bone(Bone::left_shoulder), chest, {2.2 * out, 13.8, 2.4});
        at = add(bone(Bone::left_upper_arm), at, {13.6 * out, -0.6, -2.4});
        if (extras.helpers) {
            at = add("twist", at, {13.75 * out, 0, 0});
        }
        const double rest = extras.helpers ? 13.75 : 27.5;
        at = add(bone(Bone::left_lower_arm), at, {rest * out, 0, -0.2});
        if (extras.helpers) {
            add("sleeve", at, {10.0 * out, 2, 0});
        }
        at = add(bone(Bone::left_hand), at, {23.9 * out, 0, 0.2});
        clip.joints[at].end_site = glm::dvec3(8.0 * out, 0, 0);
        if (extras.fingers) {
            clip.joints[at].end_site.reset();
            std::size_t index = add(bone(Bone::left_index_proximal), at, {9.0 * out, 0, 2});
            index = add(bone(Bone::left_index_intermediate), index, {4.0 * out, 0, 0});
            index = add(bone(Bone::left_index_distal), index, {3.0 * out, 0, 0});
            std::size_t thumb = add(bone(Bone::left_thumb_metacarpal), at, {3.0 * out, 0, 3});
            thumb = add(bone(Bone::left_thumb_proximal), thumb, {3.0 * out, 0, 2});
            add(bone(Bone::left_thumb_distal), thumb, {3.0 * out, 0, 0});
        }
    }

    void add_leg(std::size_t hips, Side side, const Extras& extras) {
        const double out = side == Side::left ? extras.turned : -extras.turned;
        const auto bone = [&](Bone left) { return on_side(left, side); };
        std::size_t at = hips;
        if (extras.helpers) {
            at = add("socket", at, {0, 0, 0});
        }
        at = add(bone(Bone::left_upper_leg), at, {8.8 * out, -3.8, 0});
        at = add(bone(Bone::left_lower_leg), at, {0, -41, 0.3});
        at = add(bone(Bone::left_foot), at, {0, -40, -1});
        clip.joints[at].end_site = glm::dvec3(0, -6, 18);
        if (extras.feet) {
            clip.joints[at].end_site.reset();
            at = add(bone(Bone::left_toes), at, {0, -6, 12});
            clip.joints[at].end_site = glm::dvec3(0, 0, 6);
        }
    }

    void dance() {
        const std::size_t count = clip.joints.size();
        clip.rotations.assign(clip.frame_count * count, glm::dquat(1, 0, 0, 0));
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            for (const ClipJoint& joint : clip.joints) {
                clip.positions.push_back(joint.offset);
            }
            if (const std::size_t hips = joints.at(Bone::hips); hips > 0) {
                clip.positions[frame * count + hips].z += 40.0 * static_cast<double>(frame);
            }
            const double phase = 2.0 * M_PI * static_cast<double>(frame) / 12.0;
            for (const auto& [bone, joint] : joints) {
                clip.rotations[frame * count + joint] = turn(bone, phase);
            }
        }
    }

    glm::dquat turn(Bone bone, double phase) const {
        const auto about = [](double angle, const glm::dvec3& axis) {
            return glm::angleAxis(angle, axis);
        };
        const bool is_left = bone < mirrored(bone);
        const double out =
            clip.joints[joints.at(Bone::left_upper_leg)].offset.x * (is_left ? 1.0 : -1.0) > 0.0
                ? 1.0
                : -1.0;
        const double wave = std::sin(phase + (is_left ? 0.0 : M_PI));
        switch (is_left ? bone : mirrored(bone)) {
            case Bone::left_upper_leg:
                return about(-0.3 - 0.3 * wave, {1, 0, 0});
            case Bone::left_lower_leg:
                return about(0.5 + 0.4 * wave, {1, 0, 0});
            case Bone::left_foot:
                return about(-0.2 - 0.1 * wave, {1, 0, 0});
            case Bone::left_shoulder:
                return about(0.05 * wave, {0, 0, 1});
            case Bone::left_upper_arm:
                return about(out * (-0.9 + 0.3 * wave), {0, 0, 1});
            case Bone::left_lower_arm:
                return about(out * (-0.8 - 0.5 * wave), {0, 1, 0});
            default:
                return about(0.05 * std::sin(phase), {0, 1, 0});
        }
    }
};

}  // namespace raks::motion::body_test
