#include "motion/skeleton/pose.hpp"

#include <cmath>

namespace raks::motion {

Pose interpolate(const Pose& from, const Pose& to, float t) noexcept {
    Pose result;
    for (std::size_t i = 0; i < from.local_rotations.size(); ++i) {
        const glm::quat& a = from.local_rotations[i];
        const glm::quat& b = to.local_rotations[i];
        const float sign = glm::dot(a, b) < 0.0F ? -t : t;
        result.local_rotations[i] = glm::normalize(a * (1.0F - t) + b * sign);
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
        result.rotation(bone) = glm::quat(q.w, q.x, -q.y, -q.z);
    }
    result.hips_position = {-pose.hips_position.x, pose.hips_position.y, pose.hips_position.z};
    result.foot_contact = {pose.foot_contact[1], pose.foot_contact[0]};
    return result;
}

}  // namespace raks::motion
