#include "motion/dance/dynamics/isolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kMostSpine = 0.65F;  // radians that the spine bends for it, approached softly

/// The bones from the hips to a head, in a row.
constexpr std::array<Bone, 6> kSpineChain = {
    Bone::hips, Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck, Bone::head};

/// Joints of the chain in the world, and the rotations of their bones.
struct SpineChain {
    std::array<glm::vec3, kSpineChain.size()> places{};
    std::array<glm::quat, kSpineChain.size()> turns{};

    SpineChain(const Skeleton& skeleton, const Pose& pose) noexcept {
        places[0] = pose.hips_position;
        turns[0] = pose.rotation(Bone::hips);
        for (std::size_t i = 1; i < kSpineChain.size(); ++i) {
            places[i] = places[i - 1] + turns[i - 1] * skeleton.offsets[index_of(kSpineChain[i])];
            turns[i] = turns[i - 1] * pose.rotation(kSpineChain[i]);
        }
    }
};

/// Turns a bone by `turn` in the world; `parent`: the rotation of its parent.
void turn_bone(Bone bone, const glm::quat& parent, const glm::quat& turn, Pose& pose) noexcept {
    pose.rotation(bone) =
        glm::normalize(glm::conjugate(parent) * turn * parent * pose.rotation(bone));
}

}  // namespace

void keep_still(const Skeleton& skeleton,
                StillPart part,
                const Pose& middle,
                Pose& pose) noexcept RAKS_NONBLOCKING {
    if (part == StillPart::nothing) {
        return;
    }
    const std::size_t joint = part == StillPart::head ? 5 : 4;
    const SpineChain now(skeleton, pose);
    const SpineChain mean(skeleton, middle);
    glm::vec3 way = mean.places[joint] - now.places[joint];
    way.y = 0.0F;
    // Spine and chest bend by the same angle; from the neck on all is turned back.
    const glm::vec3 lever = 2.0F * now.places[4] - now.places[1] - now.places[2];
    const float length = glm::length(lever);
    const glm::vec3 about = glm::cross(lever, way);
    const float square = glm::length(about);
    if (length < 1e-6F || square < 1e-9F) {
        return;
    }
    const float asked = square / (length * length);
    const float angle = kMostSpine * std::tanh(asked / kMostSpine);
    const glm::quat bend = glm::angleAxis(angle, about / square);
    turn_bone(Bone::spine, now.turns[0], bend, pose);
    turn_bone(Bone::chest, now.turns[1], bend, pose);
    // What hangs on the chest keeps its directions: turned back by both bends.
    const glm::quat back = glm::conjugate(bend * bend);
    turn_bone(Bone::neck, bend * bend * now.turns[3], back, pose);
    for (const Side side : kSides) {
        const Bone shoulder = on_side(Bone::left_shoulder, side);
        const glm::quat parent = bend * bend * now.turns[3] * pose.rotation(shoulder);
        turn_bone(on_side(Bone::left_upper_arm, side), parent, back, pose);
    }
}

}  // namespace raks::motion
