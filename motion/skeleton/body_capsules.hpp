#pragma once

#include <array>
#include <string_view>

#include "base/realtime.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/vec3.hpp>

/// Body capsules: a body's girth, for distances between hands and bodies.
namespace raks::motion {

/// A capsule: everything within `radius` of a line segment; metres.
struct Capsule {
    glm::vec3 from{};     ///< one end of the segment
    glm::vec3 to{};       ///< the other end
    float radius = 0.0F;  ///< around the segment
};

/// Names of the capsules: trunk (as two flanks), thigh, shin and foot of the left, then of the
/// right side, then the head.
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

/// The capsules of a pose, in the world. Threads: any. Real-time: yes.
[[nodiscard]] BodyCapsules body_capsules(const Girth& girth,
                                         const WorldPose& world) noexcept RAKS_NONBLOCKING;

/// Nearest points of two capsules.
struct Nearness {
    glm::vec3 away{};     ///< from the other's segment to the first one's; metres
    float metres = 0.0F;  ///< distance of the skins; negative: depth inside one another
    float at = 0.0F;      ///< where on the first one's segment, [0, 1] from its `from`
};

/// The nearest points; neither segment may be a point. Threads: any. Real-time: yes.
[[nodiscard]] Nearness nearness(const Capsule& one, const Capsule& other) noexcept RAKS_NONBLOCKING;

/// Capsules of one hand: the half of the forearm next to it, and the palm with the fingers' first
/// joints. Threads: any. Real-time: yes.
[[nodiscard]] std::array<Capsule, 2> hand_capsules(const Girth& girth,
                                                   const WorldPose& world,
                                                   Side side) noexcept RAKS_NONBLOCKING;

/// The body part nearest to a hand or its half of the forearm.
struct HandClearance {
    Side hand = Side::left;  ///< which hand
    std::string_view part;   ///< one of kBodyCapsuleNames
    double metres = 0.0;     ///< distance of the skins; negative: depth inside it
};

/// The hand deepest inside, or nearest to, trunk, legs or head. Threads: any. Real-time: yes.
[[nodiscard]] HandClearance hand_clearance(const Skeleton& skeleton,
                                           const Pose& pose) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
