#include "motion/dance/body/collar_bones.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Of a body whose leg is kLeg long; metres. Up to the first limit a shoulder is free, the second it
// never reaches. People: 2.4 and 8.6 cm in 19 of 20 pictures.
constexpr float kLeg = 0.83F;
constexpr float kFreeRise = 0.008F;
constexpr float kMostRise = 0.019F;
constexpr float kFreeDifference = 0.050F;
constexpr float kMostDifference = 0.080F;
constexpr float kNoLength = 1e-6F;  // metres
constexpr float kRaises = 0.005F;   // over the height at rest, of any body

/// As `x` up to `free`, then ever slower towards `most`; twice differentiable.
float softly_below(float x, float free, float most) noexcept {
    return x <= free ? x : free + (most - free) * std::tanh((x - free) / (most - free));
}

/// One collar bone, in the frame of the upper chest.
struct CollarBone {
    Bone shoulder;
    Bone arm;
    glm::quat turn;      // of the bone
    glm::vec3 to_joint;  // of the arm, from the bone's root
    float root;          // height of that root over the base of the neck

    CollarBone(const Skeleton& skeleton, const glm::vec3& up, Side side, const Pose& pose) noexcept
        : shoulder(on_side(Bone::left_shoulder, side)),
          arm(on_side(Bone::left_upper_arm, side)),
          turn(pose.rotation(shoulder)),
          to_joint(turn * skeleton.offsets[index_of(arm)]),
          root(glm::dot(skeleton.offsets[index_of(shoulder)], up) -
               glm::dot(skeleton.offsets[index_of(Bone::neck)], up)) {}

    [[nodiscard]] float height(const glm::vec3& up) const noexcept {
        return root + glm::dot(to_joint, up);
    }

    /// Turns the bone, the shortest way, until its end is so high; the arm keeps its direction.
    void lower(float height, const glm::vec3& up, Pose& pose) const noexcept {
        const float length = glm::length(to_joint);
        if (length < kNoLength) {
            return;
        }
        const glm::vec3 aside = to_joint - up * glm::dot(to_joint, up);
        const float now = glm::dot(to_joint, up) / length;
        const float wanted = std::clamp((height - root) / length, -0.99F, 0.99F);
        const float angle = std::asin(std::clamp(now, -1.0F, 1.0F)) - std::asin(wanted);
        const glm::vec3 axis = glm::cross(up, aside);
        if (glm::length(axis) < kNoLength * length) {
            return;
        }
        const glm::quat lowered = glm::angleAxis(angle, glm::normalize(axis)) * turn;
        pose.rotation(arm) = glm::normalize(glm::conjugate(lowered) * turn * pose.rotation(arm));
        pose.rotation(shoulder) = glm::normalize(lowered);
    }
};

}  // namespace

void limit_collar_bones(const Skeleton& skeleton, Pose& pose) noexcept RAKS_NONBLOCKING {
    const glm::vec3& neck = skeleton.offsets[index_of(Bone::neck)];
    const float scale = (glm::length(skeleton.offsets[index_of(Bone::left_lower_leg)]) +
                         glm::length(skeleton.offsets[index_of(Bone::left_foot)])) /
                        kLeg;
    if (glm::length(neck) < kNoLength || scale < kNoLength) {
        return;
    }
    const glm::vec3 up = glm::normalize(neck);
    const std::array<CollarBone, 2> bones = {CollarBone(skeleton, up, Side::left, pose),
                                             CollarBone(skeleton, up, Side::right, pose)};
    const CollarBone at_rest(skeleton, up, Side::left, Pose());
    const float least = at_rest.height(up) + scale * kRaises;
    std::array<float, 2> heights{};
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const float over = std::max(0.0F, least - scale * kMostRise);
        heights[s] =
            softly_below(bones[s].height(up), scale * kFreeRise + over, scale * kMostRise + over);
    }
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const float other = heights[1 - s];
        const float height =
            other +
            softly_below(heights[s] - other, scale * kFreeDifference, scale * kMostDifference);
        if (height < bones[s].height(up)) {
            bones[s].lower(height, up, pose);
        }
    }
}

}  // namespace raks::motion
