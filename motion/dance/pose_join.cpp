#include "motion/dance/pose_join.hpp"

#include <algorithm>

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

Pose joined_poses(const Skeleton& skeleton,
                  const Pose& from,
                  const Pose& to,
                  float share,
                  const std::array<FootShare, 2>& feet) noexcept RAKS_NONBLOCKING {
    Pose pose = interpolate(from, to, share);
    const WorldPose a = world_body(skeleton, from);
    const WorldPose b = world_body(skeleton, to);
    for (const Side side : kSides) {
        const FootShare& own = feet[static_cast<std::size_t>(side)];
        // The pivot is interpolated, so that a foot that both plant there stays, though its heel be
        // higher in one.
        FootPlace before = foot_place(skeleton, a, side);
        if (own.held && own.is_planted) {
            before = *own.held;
        } else if (own.held) {
            before.pivot = {own.held->pivot.x, before.pivot.y, own.held->pivot.z};
        }
        const FootPlace after = foot_place(skeleton, b, side);
        const glm::vec3 place = glm::mix(before.pivot, after.pivot, own.share);
        FootTarget target;
        target.rotation = glm::slerp(before.rotation, after.rotation, own.share);
        target.ankle = place - pivot_from_ankle(skeleton, side, target.rotation);
        if (own.lift > 0.0F) {
            target.ankle.y += own.lift;
            pose.foot_contact[static_cast<std::size_t>(side)] = false;
        }
        // The interpolated sole must not dip into the floor.
        const float standing = -lowest_of_sole(
            skeleton, side, target.rotation, pose.rotation(on_side(Bone::left_toes, side)));
        target.ankle.y = std::max(target.ankle.y, standing);
        solve_leg(skeleton, side, target, pose);
    }
    return pose;
}

}  // namespace raks::motion
