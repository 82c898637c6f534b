#include "training/cells/rigid_joints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/smooth_steps.hpp"
#include "motion/figures/motion_features.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kStillJoint = 0.5 / 180.0 * M_PI;  // radians within which a joint does not move
constexpr std::array<Bone, 3> kTrunk = {Bone::spine, Bone::chest, Bone::upper_chest};
// Heights of the toes' tip over the floor, metres: a foot on it is rolled, one above is in the air.
constexpr double kOnFloor = 0.03;
constexpr double kInAir = 0.08;
constexpr double kMostRoll = 0.6;  // radians that a heel is rolled further

double angle_between(const glm::quat& a, const glm::quat& b) {
    const auto cosine = static_cast<double>(std::abs(glm::dot(a, b)));
    // Better than acos where the angle is small: single floats round a cosine near 1.
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return 2.0 * std::atan2(sine, cosine);
}

bool is_halved(std::span<const Pose> poses) {
    return std::all_of(poses.begin(), poses.end(), [](const Pose& pose) {
        return angle_between(pose.rotation(Bone::spine), pose.rotation(Bone::chest)) < kStillJoint;
    });
}

// A part of a rotation, about the same axis.
glm::quat part_of(const glm::dquat& rotation, double share) {
    return glm::quat(rotation_from(share * exponential_map(rotation)));
}

// How much further a foot must turn about its own side so that its ball lies as deep under the
// ankle as its tip does now; radians, 0 where the ball is the deeper one.
double roll_of(const Skeleton& skeleton, Side side, const glm::quat& foot) {
    const double mirror = side == Side::left ? 1.0 : -1.0;
    const glm::dvec3 up = glm::conjugate(glm::dquat(foot)) * glm::dvec3(0.0, 1.0, 0.0);
    const auto own = [&](const glm::vec3& left) {
        return glm::dvec3(mirror * static_cast<double>(left.x), left.y, left.z);
    };
    const glm::dvec3 ball = own(skeleton.ball);
    const double deep = -glm::dot(up, own(skeleton.toe_tip)) + up.x * ball.x;
    // Turned by an angle a the ball is `level cos a + raised sin a` under the ankle, less its x.
    const double level = -(up.y * ball.y + up.z * ball.z);
    const double raised = up.y * ball.z - up.z * ball.y;
    const double most = std::hypot(level, raised);
    if (!(deep > level) || most < 1e-9) {
        return 0.0;
    }
    const double steepest = std::atan2(raised, level);
    return std::clamp(steepest - std::acos(std::min(1.0, deep / most)), 0.0, kMostRoll);
}

}  // namespace

bool ever_moves(std::span<const Pose> poses, Bone bone) {
    return std::any_of(poses.begin(), poses.end(), [&](const Pose& pose) {
        return angle_between(pose.rotation(bone), poses.front().rotation(bone)) > kStillJoint;
    });
}

bool spread_trunk(std::span<Pose> poses) {
    if (poses.empty()) {
        return false;
    }
    const auto moving = std::count_if(
        kTrunk.begin(), kTrunk.end(), [&](Bone bone) { return ever_moves(poses, bone); });
    const bool is_one =
        moving == 1 || (moving == 2 && !ever_moves(poses, Bone::upper_chest) && is_halved(poses));
    if (!is_one) {
        return false;
    }
    for (Pose& pose : poses) {
        glm::dquat whole(1.0, 0.0, 0.0, 0.0);
        for (const Bone bone : kTrunk) {
            whole = whole * glm::dquat(pose.rotation(bone));
        }
        pose.rotation(Bone::spine) = part_of(whole, kLowerTrunkShare);
        pose.rotation(Bone::chest) = part_of(whole, 1.0 - kLowerTrunkShare);
        pose.rotation(Bone::upper_chest) = kNoRotation;
    }
    return true;
}

bool roll_heels(const Skeleton& skeleton,
                std::span<const std::array<SourceFoot, 2>> feet,
                std::span<Pose> poses) {
    if (poses.empty() || ever_moves(poses, Bone::left_toes) ||
        ever_moves(poses, Bone::right_toes)) {
        return false;
    }
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const WorldPose world = world_body(skeleton, poses[frame]);
        for (const Side side : kSides) {
            const Bone foot = on_side(Bone::left_foot, side);
            const double height = feet[frame][static_cast<std::size_t>(side)].toe_tip.y;
            const float in_air = smootherstep(static_cast<float>(
                std::clamp((height - kOnFloor) / (kInAir - kOnFloor), 0.0, 1.0)));
            const auto roll = static_cast<float>(roll_of(skeleton, side, world.rotation(foot)));
            glm::quat& own = poses[frame].rotation(foot);
            own = glm::normalize(
                own * glm::angleAxis((1.0F - in_air) * roll, glm::vec3(1.0F, 0.0F, 0.0F)));
        }
    }
    return true;
}

}  // namespace raks::motion
