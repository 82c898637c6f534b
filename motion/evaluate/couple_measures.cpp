#include "motion/evaluate/couple_measures.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "motion/skeleton/body_capsules.hpp"
#include "motion/skeleton/palm.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Horizontal angle between where the hips face and where the other one is, [0, pi].
double angle_past(const WorldPose& who, const glm::vec3& other) {
    const glm::vec3 ahead = who.rotation(Bone::hips) * glm::vec3(0.0F, 0.0F, 1.0F);
    const glm::vec3 to = other - who.position(Bone::hips);
    const auto past = static_cast<double>(std::atan2(to.x, to.z) - std::atan2(ahead.x, ahead.z));
    return std::abs(std::remainder(past, 2.0 * M_PI));
}

}  // namespace

double body_clearance(const Skeleton& skeleton, const Pose& one, const Pose& other) {
    float least = 1e9F;
    const BodyCapsules others = body_capsules(skeleton.girth, world_body(skeleton, other));
    // Nine capsules against nine: cheap enough without a hierarchy.
    for (const Capsule& a : body_capsules(skeleton.girth, world_body(skeleton, one))) {
        for (const Capsule& b : others) {
            least = std::min(least, nearness(a, b).metres);
        }
    }
    return static_cast<double>(least);
}

PalmsAt measure_palms(const Skeleton& skeleton,
                      const PalmPair& pair,
                      const Pose& lead,
                      const Pose& follow) {
    const glm::vec3 own = palm_of(world_body(skeleton, lead), pair.lead);
    const glm::vec3 other = palm_of(world_body(skeleton, follow), pair.follow);
    return {static_cast<double>(glm::distance(own, other)),
            0.5 * static_cast<double>(own.y + other.y)};
}

CoupleMeasures measure_couple(const Skeleton& skeleton,
                              std::span<const Pose> lead,
                              std::span<const Pose> follow) {
    RAKS_ASSERT(lead.size() == follow.size());
    CoupleMeasures measures;
    for (std::size_t i = 0; i < lead.size(); ++i) {
        const WorldPose a = world_body(skeleton, lead[i]);
        const WorldPose b = world_body(skeleton, follow[i]);
        measures.hands.push_back(static_cast<double>(
            glm::distance(a.position(Bone::left_hand), b.position(Bone::right_hand))));
        measures.facing.push_back(
            std::max(angle_past(a, b.position(Bone::hips)), angle_past(b, a.position(Bone::hips))));
        measures.closest.push_back(body_clearance(skeleton, lead[i], follow[i]));
    }
    return measures;
}

}  // namespace raks::motion
