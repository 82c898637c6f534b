#include "motion/skeleton/pose.hpp"

#include <cmath>

namespace raks::motion {

glm::quat interpolate(const glm::quat& from, const glm::quat& to, float t) noexcept {
    // q and -q are the same rotation: take the one on the shorter arc.
    const float sign = glm::dot(from, to) < 0.0F ? -t : t;
    return glm::normalize(from * (1.0F - t) + to * sign);
}

Pose interpolate(const Pose& from, const Pose& to, float t) noexcept {
    Pose result;
    for (std::size_t i = 0; i < from.local_rotations.size(); ++i) {
        result.local_rotations[i] = interpolate(from.local_rotations[i], to.local_rotations[i], t);
    }
    result.hips_position = from.hips_position * (1.0F - t) + to.hips_position * t;
    result.foot_contact = t < 0.5F ? from.foot_contact : to.foot_contact;
    return result;
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

}  // namespace raks::motion
