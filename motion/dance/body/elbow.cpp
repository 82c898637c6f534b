#include "motion/dance/body/elbow.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr float kSmallestAside = 1e-4F;  // metres; less is a straight limb, or no direction
// Radians: up to the first the middle joint is turned all the way, from the second on not at all.
constexpr float kSurelyTurned = 2.2F;
constexpr float kFarTurned = 3.0F;

}  // namespace

void turn_elbow(const Skeleton& skeleton,
                const Limb& limb,
                const glm::vec3& aim,
                float share,
                Pose& pose) noexcept RAKS_NONBLOCKING {
    const glm::quat upper = limb.parent * pose.rotation(limb.upper);
    const glm::vec3 middle = upper * skeleton.offsets[index_of(limb.lower)];
    const glm::vec3 end =
        middle + upper * pose.rotation(limb.lower) * skeleton.offsets[index_of(limb.end)];
    const float length = glm::length(end);
    if (length < kSmallestAside) {
        return;
    }
    const glm::vec3 line = end / length;
    const glm::vec3 now = middle - line * glm::dot(middle, line);
    const glm::vec3 wanted = aim - line * glm::dot(aim, line);
    if (std::min(glm::dot(now, now), glm::dot(wanted, wanted)) < kSmallestAside * kSmallestAside) {
        return;
    }
    const float angle = std::atan2(glm::dot(glm::cross(now, wanted), line), glm::dot(now, wanted));
    const float sure = 1.0F - smoothstep(kSurelyTurned, kFarTurned, std::abs(angle));
    const glm::quat turn = glm::angleAxis(share * sure * angle, line);
    pose.rotation(limb.upper) = glm::normalize(glm::conjugate(limb.parent) * turn * upper);
}

}  // namespace raks::motion
