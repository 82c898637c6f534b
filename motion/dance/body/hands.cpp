#include "motion/dance/body/hands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "motion/dance/body/curves.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/body_capsules.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

struct Bend {
    Bone bone;  // left
    float radians;
};
// 15 to 25 degrees a joint, more toward the little finger: a hand held up, neither a claw nor a
// fist.
constexpr std::array<Bend, 15> kBends = {{
    {Bone::left_index_proximal, 0.26F},
    {Bone::left_index_intermediate, 0.32F},
    {Bone::left_index_distal, 0.26F},
    {Bone::left_middle_proximal, 0.32F},
    {Bone::left_middle_intermediate, 0.38F},
    {Bone::left_middle_distal, 0.28F},
    {Bone::left_ring_proximal, 0.37F},
    {Bone::left_ring_intermediate, 0.42F},
    {Bone::left_ring_distal, 0.3F},
    {Bone::left_little_proximal, 0.40F},
    {Bone::left_little_intermediate, 0.43F},
    {Bone::left_little_distal, 0.3F},
    {Bone::left_thumb_metacarpal, 0.27F},
    {Bone::left_thumb_proximal, 0.3F},
    {Bone::left_thumb_distal, 0.4F},
}};
constexpr glm::vec3 kFingerAxis{0.0F, 0.0F, -1.0F};  // of the left hand: bends toward the palm
constexpr glm::vec3 kThumbAxis{0.0F, -0.70711F, -0.70711F};
// The thumb's root closes toward the index finger and a little down.
constexpr glm::vec3 kThumbRootAxis{0.0F, 0.89443F, -0.44721F};

}  // namespace

void relax_hands(Pose& pose) noexcept RAKS_NONBLOCKING {
    for (const Bend& bend : kBends) {
        const bool is_thumb =
            bend.bone == Bone::left_thumb_proximal || bend.bone == Bone::left_thumb_distal;
        const glm::vec3 axis = bend.bone == Bone::left_thumb_metacarpal ? kThumbRootAxis
                               : is_thumb                               ? kThumbAxis
                                                                        : kFingerAxis;
        const glm::quat q = glm::angleAxis(bend.radians, axis);
        pose.rotation(bend.bone) = q;
        pose.rotation(mirrored(bend.bone)) = glm::quat(q.w, q.x, -q.y, -q.z);
    }
}

namespace {

constexpr float kSoft = 0.035F;  // metres; distance from the skin at which a hand is pushed first
// Weight of the outward direction, metres. It decides where a hand goes that is deep inside, where
// the nearest skin says nothing. Much smaller, and a hand that passes through the trunk turns from
// one skin to the other within a few ms: at 0.03 m with up to 8,200 m/s^3, at 0.12 m with 3,600
// (salsa, lead and follow).
constexpr float kOutward = 0.12F;
constexpr int kRounds = 2;           // a push out of one part may lead into another
constexpr float kLeastPush = 1e-5F;  // metres; less is ignored

// For lead_hands_round(): arms are drawn for one trunk and danced on others, so they keep more
// distance.
constexpr float kSpare = 0.04F;      // metres
constexpr double kPushSigma = 0.15;  // beats; deviation of the Gaussian over the pushes
constexpr int kClearings = 4;        // rounds, as a smoothed push may fall short

/// `depth`, rounded where it begins; once differentiable, 0 below -kSoft.
float soft_depth(float depth) noexcept {
    if (depth <= -kSoft) {
        return 0.0F;
    }
    return depth >= kSoft ? depth : (depth + kSoft) * (depth + kSoft) / (4.0F * kSoft);
}

/// A ball around a capsule.
struct Ball {
    glm::vec3 middle{};
    float radius = 0.0F;
};

Ball ball_around(const Capsule& capsule) noexcept {
    return {0.5F * (capsule.from + capsule.to),
            0.5F * glm::distance(capsule.from, capsule.to) + capsule.radius};
}

/// A body with a ball around each part: most of it is far from a hand.
struct Obstacles {
    BodyCapsules parts;
    std::array<Ball, std::tuple_size_v<BodyCapsules>> balls;

    Obstacles(const Girth& girth, const WorldPose& world) noexcept
        : parts(body_capsules(girth, world)) {
        std::transform(parts.begin(), parts.end(), balls.begin(), ball_around);
    }
};

/// Whether the parts in two balls are so far apart that neither pushes the other.
bool is_clear(const Ball& one, const Ball& other, float spare) noexcept {
    constexpr float kRounding = 1e-4F;  // metres; more than the distances are off by
    const glm::vec3 between = one.middle - other.middle;
    const float reach = one.radius + other.radius + spare + kSoft + kRounding;
    return glm::dot(between, between) > reach * reach;
}

/// Vector by which a hand must move to stay `spare` metres off the skin; metres, world.
glm::vec3 push_of(const std::array<Capsule, 2>& hand,
                  const Obstacles& body,
                  const glm::vec3& outward,
                  float spare) noexcept {
    glm::vec3 push{};
    std::array<Capsule, 2> moved = hand;
    std::array<Ball, 2> balls = {ball_around(moved[0]), ball_around(moved[1])};
    bool is_pushed = true;
    for (int round = 0; round < kRounds && is_pushed; ++round) {
        is_pushed = false;
        for (std::size_t part = 0; part < body.parts.size(); ++part) {
            for (std::size_t i = 0; i < hand.size(); ++i) {
                if (is_clear(balls[i], body.balls[part], spare)) {
                    continue;
                }
                const Nearness near = nearness(moved[i], body.parts[part]);
                const float depth = soft_depth(spare - near.metres);
                if (depth > 0.0F) {
                    push += depth * glm::normalize(near.away + kOutward * outward);
                    is_pushed = true;
                    for (std::size_t k = 0; k < hand.size(); ++k) {
                        moved[k].from = hand[k].from + push;
                        moved[k].to = hand[k].to + push;
                        balls[k] = ball_around(moved[k]);
                    }
                }
            }
        }
    }
    return push;
}

/// Direction from the hips in which nothing is in the way of a hand of that side: sideways and
/// ahead; world.
glm::vec3 outward_of(const WorldPose& world, Side side) noexcept {
    const float sign = side == Side::left ? 1.0F : -1.0F;
    return world.rotation(Bone::hips) * glm::vec3(0.6F * sign, 0.0F, 0.8F);
}

// Moves the wrist by `push`, the arm following.
void push_hand(const Skeleton& skeleton,
               const WorldPose& world,
               Side side,
               const glm::vec3& push,
               Pose& pose) noexcept {
    const Limb arm = arm_of(world, side);
    solve_limb(skeleton, arm, world.position(arm.end) + push, pose);
}

/// The pushes of one hand by pose, in the frame of the hips: the largest within about a deviation
/// to each side, then smoothed, so that the result hardly falls below what a pose needs.
std::vector<glm::vec3> smooth_pushes(const std::vector<glm::vec3>& pushes, double sigma) {
    const auto size = std::ssize(pushes);
    const auto around = static_cast<std::ptrdiff_t>(std::lround(sigma));
    std::vector<glm::dvec3> largest(pushes.size());
    for (std::ptrdiff_t i = 0; i < size; ++i) {
        const auto first = pushes.begin() + std::max<std::ptrdiff_t>(0, i - around);
        const auto last = pushes.begin() + std::min(size, i + around + 1);
        largest[static_cast<std::size_t>(i)] =
            *std::max_element(first, last, [](const glm::vec3& a, const glm::vec3& b) {
                return glm::dot(a, a) < glm::dot(b, b);
            });
    }
    std::vector<glm::vec3> result(pushes.size());
    for (glm::vec3::length_type axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(largest.size());
        for (const glm::dvec3& push : largest) {
            values.push_back(push[axis]);
        }
        const std::vector<double> smooth = smoothed(values, sigma);
        for (std::size_t i = 0; i < smooth.size(); ++i) {
            result[i][axis] = static_cast<float>(smooth[i]);
        }
    }
    return result;
}

}  // namespace

void clear_hands(const Skeleton& skeleton, Pose& pose) noexcept RAKS_NONBLOCKING {
    const WorldPose world = world_body(skeleton, pose);
    const Obstacles body(skeleton.girth, world);
    for (const Side side : kSides) {
        const glm::vec3 push = push_of(
            hand_capsules(skeleton.girth, world, side), body, outward_of(world, side), 0.0F);
        if (glm::dot(push, push) >= kLeastPush * kLeastPush) {
            push_hand(skeleton, world, side, push, pose);
        }
    }
}

void lead_hands_round(const Skeleton& skeleton, double samples_per_beat, std::vector<Pose>& poses) {
    for (const Side side : kSides) {
        for (int look = 0; look < kClearings; ++look) {
            std::vector<glm::vec3> pushes;
            pushes.reserve(poses.size());
            float most = 0.0F;
            for (const Pose& pose : poses) {
                const WorldPose world = world_body(skeleton, pose);
                const glm::vec3 push = push_of(hand_capsules(skeleton.girth, world, side),
                                               Obstacles(skeleton.girth, world),
                                               outward_of(world, side),
                                               kSpare);
                // In the frame of the hips, so that a turn of the body does not rotate the pushes
                // that are smoothed.
                pushes.push_back(glm::conjugate(world.rotation(Bone::hips)) * push);
                most = std::max(most, glm::dot(push, push));
            }
            if (most < kLeastPush * kLeastPush) {
                break;
            }
            pushes = smooth_pushes(pushes, kPushSigma * samples_per_beat);
            for (std::size_t i = 0; i < poses.size(); ++i) {
                if (glm::dot(pushes[i], pushes[i]) >= kLeastPush * kLeastPush) {
                    const WorldPose world = world_body(skeleton, poses[i]);
                    push_hand(
                        skeleton, world, side, world.rotation(Bone::hips) * pushes[i], poses[i]);
                }
            }
        }
    }
}

}  // namespace raks::motion
