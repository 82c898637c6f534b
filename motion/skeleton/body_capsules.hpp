#pragma once

#include <array>
#include <string_view>

#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

/// The mannequin's girth: what bodies and hands run into.
namespace raks::motion {

/// A stretch of the body: everything within `radius` of a line; metres.
struct Capsule {
    glm::vec3 from{};
    glm::vec3 to{};
    float radius = 0.0F;
};

/// Trunk (two flanks), thighs, shins and feet of both sides in turn, then the head.
inline constexpr std::array<std::string_view, 9> kBodyCapsuleNames = {"trunk",
                                                                      "left thigh",
                                                                      "left shin",
                                                                      "left foot",
                                                                      "trunk",
                                                                      "right thigh",
                                                                      "right shin",
                                                                      "right foot",
                                                                      "head"};
using BodyCapsules = std::array<Capsule, kBodyCapsuleNames.size()>;

/// In the world. Threads: any. Real-time: yes.
[[nodiscard]] BodyCapsules body_capsules(const WorldPose& world) noexcept;

/// Where two capsules are nearest to one another.
struct Nearness {
    glm::vec3 away{};     ///< from the other's line to the one's; metres
    float metres = 0.0F;  ///< from skin to skin; negative: so deep into one another
};

/// Neither line is a point. Threads: any. Real-time: yes.
[[nodiscard]] Nearness nearness(const Capsule& one, const Capsule& other) noexcept;

/// The half of a forearm next to the hand; the palm with the fingers' first joints.
[[nodiscard]] std::array<Capsule, 2> hand_capsules(const WorldPose& world, Side side) noexcept;

/// A hand, or the half of its forearm next to it, and what of the body is nearest to it.
struct HandClearance {
    Side hand = Side::left;
    std::string_view part;  ///< of kBodyCapsuleNames
    double metres = 0.0;    ///< from skin to skin; negative: so deep in it
};

/// The hand that is deepest in, or nearest to, trunk, legs or head. Threads: any. Real-time: yes.
[[nodiscard]] HandClearance hand_clearance(const Skeleton& skeleton, const Pose& pose) noexcept;

}  // namespace raks::motion
