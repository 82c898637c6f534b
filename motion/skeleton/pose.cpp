#include "motion/skeleton/pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace raks::motion {

glm::quat interpolate(const glm::quat& from,
                      const glm::quat& to,
                      float t) noexcept RAKS_NONBLOCKING {
    // q and -q are the same rotation: take the one on the shorter arc.
    const float sign = glm::dot(from, to) < 0.0F ? -t : t;
    return glm::normalize(from * (1.0F - t) + to * sign);
}

Pose interpolate(const Pose& from, const Pose& to, float t) noexcept RAKS_NONBLOCKING {
    Pose result;
    for (std::size_t i = 0; i < from.local_rotations.size(); ++i) {
        result.local_rotations[i] = interpolate(from.local_rotations[i], to.local_rotations[i], t);
    }
    result.hips_position = from.hips_position * (1.0F - t) + to.hips_position * t;
    result.foot_contact = t < 0.5F ? from.foot_contact : to.foot_contact;
    return result;
}

Pose pose_between(std::span<const Pose> poses, double index) noexcept RAKS_NONBLOCKING {
    const std::size_t last = poses.size() - 1;
    const double at = std::clamp(index, 0.0, static_cast<double>(last));
    const auto before = static_cast<std::size_t>(at);
    return interpolate(poses[before],
                       poses[std::min(before + 1, last)],
                       static_cast<float>(at - static_cast<double>(before)));
}

Pose mirrored(const Pose& pose) noexcept {
    Pose result;
    for (int i = 0; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        const glm::quat& q = pose.rotation(mirrored(bone));
        // In the mirror x = 0 rotations about y and z change sign.
        result.rotation(bone) = glm::quat(q.w, q.x, -q.y, -q.z);
    }
    result.hips_position = {-pose.hips_position.x, pose.hips_position.y, pose.hips_position.z};
    result.foot_contact = {pose.foot_contact[1], pose.foot_contact[0]};
    return result;
}

namespace {

struct FingerCurl {
    Bone bone;        // left
    double straight;  // degrees of bend in an open hand
    double fist;      // degrees of bend in a fist
};
constexpr std::array<FingerCurl, 15> kFingers = {{
    {Bone::left_index_proximal, 2, 72},
    {Bone::left_index_intermediate, 5, 92},
    {Bone::left_index_distal, 3, 55},
    {Bone::left_middle_proximal, 4, 76},
    {Bone::left_middle_intermediate, 7, 95},
    {Bone::left_middle_distal, 4, 58},
    {Bone::left_ring_proximal, 6, 78},
    {Bone::left_ring_intermediate, 9, 95},
    {Bone::left_ring_distal, 5, 58},
    {Bone::left_little_proximal, 7, 80},
    {Bone::left_little_intermediate, 9, 90},
    {Bone::left_little_distal, 5, 58},
    {Bone::left_thumb_metacarpal, 4, 26},
    {Bone::left_thumb_proximal, 6, 34},
    {Bone::left_thumb_distal, 8, 48},
}};

bool is_thumb(Bone left) noexcept {
    return left == Bone::left_thumb_metacarpal || left == Bone::left_thumb_proximal ||
           left == Bone::left_thumb_distal;
}

}  // namespace

void set_hand_shape(Side side, double fist, Pose& pose) noexcept RAKS_NONBLOCKING {
    // Axes of the left hand, palms down in T-pose; the right one is the mirror image.
    constexpr glm::dvec3 kFingerAxis{0.0, 0.0, -1.0};
    constexpr glm::dvec3 kThumbAxis{0.0, -0.70710678, -0.70710678};
    for (const FingerCurl& finger : kFingers) {
        const double degrees = std::lerp(finger.straight, finger.fist, fist);
        const glm::dquat q =
            glm::angleAxis(glm::radians(degrees), is_thumb(finger.bone) ? kThumbAxis : kFingerAxis);
        const glm::dquat own = side == Side::left ? q : glm::dquat(q.w, q.x, -q.y, -q.z);
        pose.rotation(on_side(finger.bone, side)) = glm::quat(glm::normalize(own));
    }
}

// A sum is finite only if all its terms are.
bool is_finite(const Pose& pose) noexcept {
    for (const glm::quat& q : pose.local_rotations) {
        if (!std::isfinite(q.w + q.x + q.y + q.z)) {
            return false;
        }
    }
    const glm::vec3& p = pose.hips_position;
    return std::isfinite(p.x + p.y + p.z);
}

}  // namespace raks::motion
