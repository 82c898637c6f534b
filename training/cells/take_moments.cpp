#include "training/cells/take_moments.hpp"

#include <algorithm>
#include <cmath>

#include "motion/figures/motion_features.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Weights against centimetres, from a prototype on the dances of a professional.
constexpr double kVelocityWeight = 0.10;
constexpr double kTurningWeight = 0.05;  // of degrees a second
constexpr double kOneFootDiffers = 3.0;

constexpr double kCentimetres = 100.0;
constexpr double kDegrees = 180.0 / M_PI;

// Index of the counterpart of a joint in kMomentBones.
constexpr std::size_t counterpart(std::size_t joint) noexcept {
    return joint < 3 ? joint : joint % 2 == 1 ? joint + 1 : joint - 1;
}

// The heading of each frame, without leaps.
std::vector<double> headings_of(std::span<const Pose> poses) {
    std::vector<double> headings;
    for (const Pose& pose : poses) {
        const double heading = heading_of(glm::dquat(pose.rotation(Bone::hips)));
        const double before = headings.empty() ? heading : headings.back();
        headings.push_back(before + std::remainder(heading - before, 2.0 * M_PI));
    }
    return headings;
}

glm::dvec2 seen_from(double heading, double x, double z) noexcept {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {c * x - s * z, s * x + c * z};
}

template <class Values>
double mean_square(const Values& a, const Values& b) noexcept {
    double sum = 0.0;
    for (std::size_t joint = 0; joint < a.size(); ++joint) {
        const glm::dvec3 apart = a[joint] - b[joint];
        sum += glm::dot(apart, apart);
    }
    return sum / static_cast<double>(a.size());
}

}  // namespace

double TakeMoment::speed() const noexcept {
    double sum = 0.0;
    for (const glm::dvec3& velocity : velocities) {
        sum += glm::length(velocity);
    }
    return sum / static_cast<double>(velocities.size());
}

std::vector<TakeMoment> moments_of(std::span<const Pose> poses,
                                   double frames_per_second,
                                   const Skeleton& body,
                                   const std::array<std::vector<bool>, 2>& planted) {
    const std::vector<double> headings = headings_of(poses);
    std::vector<TakeMoment> moments(poses.size());
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const WorldPose world = world_pose(body, poses[frame]);
        const glm::vec3 hips = world.position(Bone::hips);
        for (std::size_t joint = 0; joint < kMomentBones.size(); ++joint) {
            const glm::dvec3 place = world.position(kMomentBones[joint]);
            const glm::dvec2 over_floor = seen_from(headings[frame],
                                                    place.x - static_cast<double>(hips.x),
                                                    place.z - static_cast<double>(hips.z));
            moments[frame].places[joint] = {over_floor.x, place.y, over_floor.y};
        }
        for (std::size_t side = 0; side < planted.size(); ++side) {
            moments[frame].is_planted[side] = planted[side][frame];
        }
    }
    // Central differences, one-sided at the ends.
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const std::size_t before = frame > 0 ? frame - 1 : 0;
        const std::size_t after = std::min(frame + 1, poses.size() - 1);
        const double seconds =
            std::max(1.0, static_cast<double>(after - before)) / frames_per_second;
        TakeMoment& moment = moments[frame];
        for (std::size_t joint = 0; joint < kMomentBones.size(); ++joint) {
            moment.velocities[joint] =
                (moments[after].places[joint] - moments[before].places[joint]) / seconds;
        }
        const glm::dvec3 way = glm::dvec3(poses[after].hips_position - poses[before].hips_position);
        moment.hips_velocity = seen_from(headings[frame], way.x, way.z) / seconds;
        moment.turning = (headings[after] - headings[before]) / seconds;
    }
    return moments;
}

TakeMoment mirrored(const TakeMoment& moment) noexcept {
    TakeMoment result = moment;
    const glm::dvec3 flip(-1.0, 1.0, 1.0);
    for (std::size_t joint = 0; joint < kMomentBones.size(); ++joint) {
        result.places[joint] = flip * moment.places[counterpart(joint)];
        result.velocities[joint] = flip * moment.velocities[counterpart(joint)];
    }
    result.hips_velocity.x = -moment.hips_velocity.x;
    result.turning = -moment.turning;
    std::swap(result.is_planted[0], result.is_planted[1]);
    return result;
}

double distance(const TakeMoment& a, const TakeMoment& b) noexcept {
    const glm::dvec2 way = a.hips_velocity - b.hips_velocity;
    const double velocities = mean_square(a.velocities, b.velocities) + glm::dot(way, way);
    const double turning = kTurningWeight * kDegrees * (a.turning - b.turning);
    const double squares =
        kCentimetres * kCentimetres *
            (mean_square(a.places, b.places) + kVelocityWeight * kVelocityWeight * velocities) +
        turning * turning;
    double feet = 0.0;
    for (std::size_t side = 0; side < a.is_planted.size(); ++side) {
        feet += a.is_planted[side] != b.is_planted[side] ? kOneFootDiffers : 0.0;
    }
    return std::sqrt(squares) + feet;
}

}  // namespace raks::motion
