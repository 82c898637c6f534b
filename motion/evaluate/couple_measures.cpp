#include "motion/evaluate/couple_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/assert.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

/// A stretch of the body: everything within `radius` of a line; metres of the mannequin.
struct Capsule {
    glm::vec3 from{};
    glm::vec3 to{};
    float radius = 0.0F;
};
using BodyCapsules = std::array<Capsule, 9>;

// Girth of the mannequin (render/avatar): the trunk is two flanks, 0.29 m wide and 0.17 m deep.
constexpr float kFlank = 0.06F;
constexpr float kTrunkRadius = 0.085F;
constexpr float kHeadRadius = 0.08F;
constexpr float kThighRadius = 0.07F;
constexpr float kShinRadius = 0.05F;
constexpr float kHeadHeight = 0.14F;  // of the head's middle over its joint and below its crown

BodyCapsules capsules_of(const Skeleton& skeleton, const Pose& pose) {
    const WorldPose world = world_pose(skeleton, pose);
    BodyCapsules capsules;
    std::size_t at = 0;
    for (const Side side : kSides) {
        const float aside = side == Side::left ? kFlank : -kFlank;
        const auto joint = [&](Bone left) { return world.position(on_side(left, side)); };
        capsules[at++] = {world.point(Bone::hips, {aside, 0.0F, 0.0F}),
                          world.point(Bone::upper_chest, {aside, 0.05F, 0.0F}),
                          kTrunkRadius};
        capsules[at++] = {joint(Bone::left_upper_leg), joint(Bone::left_lower_leg), kThighRadius};
        capsules[at++] = {joint(Bone::left_lower_leg), joint(Bone::left_foot), kShinRadius};
        capsules[at++] = {joint(Bone::left_foot), joint(Bone::left_toes), 0.5F * kShinRadius};
    }
    capsules[at] = {world.position(Bone::neck),
                    world.point(Bone::head, {0.0F, kHeadHeight, 0.0F}),
                    kHeadRadius};
    return capsules;
}

/// Least distance between the points of two segments (Ericson 2005, "Real-Time Collision
/// Detection", 5.1.9). Neither is a point.
float distance_of(const Capsule& one, const Capsule& other) {
    const glm::vec3 a = one.to - one.from;
    const glm::vec3 b = other.to - other.from;
    const glm::vec3 between = one.from - other.from;
    const float aa = glm::dot(a, a);
    const float bb = glm::dot(b, b);
    const float ab = glm::dot(a, b);
    const float ac = glm::dot(a, between);
    const float bc = glm::dot(b, between);
    const float slant = aa * bb - ab * ab;
    constexpr float kParallel = 1e-9F;
    const float first =
        slant > kParallel ? std::clamp((ab * bc - ac * bb) / slant, 0.0F, 1.0F) : 0.0F;
    const float free = (ab * first + bc) / bb;
    const float second = std::clamp(free, 0.0F, 1.0F);
    const float s = std::clamp((ab * second - ac) / aa, 0.0F, 1.0F);
    return glm::distance(one.from + s * a, other.from + second * b);
}

double angle_past(const WorldPose& who, const glm::vec3& other) {
    const glm::vec3 ahead = who.rotation(Bone::hips) * glm::vec3(0.0F, 0.0F, 1.0F);
    const glm::vec3 to = other - who.position(Bone::hips);
    const auto past = static_cast<double>(std::atan2(to.x, to.z) - std::atan2(ahead.x, ahead.z));
    return std::abs(std::remainder(past, 2.0 * M_PI));
}

}  // namespace

double body_clearance(const Skeleton& skeleton, const Pose& one, const Pose& other) {
    float least = 1e9F;
    const BodyCapsules others = capsules_of(skeleton, other);
    for (const Capsule& a : capsules_of(skeleton, one)) {
        for (const Capsule& b : others) {
            least = std::min(least, distance_of(a, b) - a.radius - b.radius);
        }
    }
    return static_cast<double>(least);
}

CoupleMeasures measure_couple(const Skeleton& skeleton,
                              std::span<const Pose> lead,
                              std::span<const Pose> follow) {
    RAKS_ASSERT(lead.size() == follow.size());
    CoupleMeasures measures;
    for (std::size_t i = 0; i < lead.size(); ++i) {
        const WorldPose a = world_pose(skeleton, lead[i]);
        const WorldPose b = world_pose(skeleton, follow[i]);
        measures.hands.push_back(static_cast<double>(
            glm::distance(a.position(Bone::left_hand), b.position(Bone::right_hand))));
        measures.facing.push_back(
            std::max(angle_past(a, b.position(Bone::hips)), angle_past(b, a.position(Bone::hips))));
        measures.closest.push_back(body_clearance(skeleton, lead[i], follow[i]));
    }
    return measures;
}

}  // namespace raks::motion
