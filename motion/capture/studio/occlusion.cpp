#include "motion/capture/studio/occlusion.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace raks::capture {

using motion::Bone;
using motion::Capsule;

std::vector<Capsule> hiding_capsules(const motion::Skeleton& skeleton,
                                     const motion::WorldPose& world) {
    const motion::BodyCapsules body = motion::body_capsules(skeleton.girth, world);
    std::vector<Capsule> capsules(body.begin(), body.end());
    for (const motion::Side side : motion::kSides) {
        const auto joint = [&](Bone left) { return world.position(motion::on_side(left, side)); };
        constexpr float kUpperArm = 1.4F;  // radius, times the forearm's
        const float forearm = skeleton.girth.forearm;
        capsules.push_back(
            {joint(Bone::left_upper_arm), joint(Bone::left_lower_arm), kUpperArm * forearm});
        capsules.push_back({joint(Bone::left_lower_arm), joint(Bone::left_hand), forearm});
        capsules.push_back(
            {joint(Bone::left_hand), joint(Bone::left_middle_intermediate), skeleton.girth.hand});
    }
    return capsules;
}

bool is_hidden(const std::vector<Capsule>& capsules,
               const glm::vec3& place,
               const glm::vec3& centre) {
    constexpr float kInside = 0.95F;
    const Capsule ray{place, centre, 0.0F};
    const Capsule spot{place, place + 1e-4F * glm::normalize(centre - place), 0.0F};
    return std::any_of(capsules.begin(), capsules.end(), [&](const Capsule& capsule) {
        const float own = motion::nearness(spot, capsule).metres + capsule.radius;
        const float reach = std::min(capsule.radius, kInside * own);
        return motion::nearness(ray, capsule).metres + capsule.radius < reach;
    });
}

}  // namespace raks::capture
