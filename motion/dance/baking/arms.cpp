#include "motion/dance/baking/arms.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/smooth_steps.hpp"
#include "motion/dance/body/limb_ik.hpp"
#include "motion/skeleton/palm.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

// Weight of a sample's own direction against its two neighbours' (1 together): a power of the found
// length's share of the bone's, plus this. With the sixth power a bone of 0.9 of its length is
// smoothed over a sample or two and one of 0.3 over a third of a beat.
constexpr double kLeastTrust = 0.01;
constexpr int kBonePower = 6;  // for bones
constexpr int kBendPower = 2;  // for the side of the elbow
constexpr int kRounds = 150;   // Gauss-Seidel sweeps
constexpr double kTiny = 1e-6;
// Sine of the smallest bend of an elbow. In a straighter arm the elbow's plane, and with it the
// upper arm's turn about itself, would be noise; people's elbows are hardly ever straighter.
constexpr double kLeastBend = 0.25;
// Radians; soft limit of a varied direction's distance from the learnt one
constexpr double kFarthestTurned = 0.5;

/// Column at which a joint's three features begin.
std::size_t column_of(const PartModel& part, Bone bone) {
    const auto joint = std::find_if(
        part.joints.begin(), part.joints.end(), [bone](const auto& j) { return j.bone == bone; });
    return part.root_features() + 3 * static_cast<std::size_t>(joint - part.joints.begin());
}

/// Columns of one arm's joints in a row, and its bones' lengths (metres of the source body).
struct ArmLayout {
    std::size_t shoulder = 0;
    std::size_t elbow = 0;
    std::size_t hand = 0;
    double upper = 0.0;
    double lower = 0.0;
};

ArmLayout layout_of(const PartModel& part, const Skeleton& body, Side side) {
    const Bone elbow = on_side(Bone::left_lower_arm, side);
    const Bone hand = on_side(Bone::left_hand, side);
    return {column_of(part, on_side(Bone::left_upper_arm, side)),
            column_of(part, elbow),
            column_of(part, hand),
            static_cast<double>(glm::length(body.offsets[index_of(elbow)])),
            static_cast<double>(glm::length(body.offsets[index_of(hand)]))};
}

/// Unit directions by sample: of both bones, and from the upper arm's line to where the elbow bends
/// the lower arm.
struct Arm {
    std::vector<glm::dvec3> uppers;
    std::vector<glm::dvec3> lowers;
    std::vector<glm::dvec3> sides;
};

glm::dvec3 vector_at(std::span<const double> row, std::size_t at) {
    return {row[at], row[at + 1], row[at + 2]};
}

/// Smoothed unit directions of vectors whose full length is `length`; the shorter a vector, the
/// more its neighbours count.
std::vector<glm::dvec3> directions_of(const std::vector<glm::dvec3>& vectors,
                                      double length,
                                      int power) {
    const std::size_t size = vectors.size();
    std::vector<glm::dvec3> own(size);  // times its weight
    std::vector<glm::dvec3> directions(size, glm::dvec3(0.0, -1.0, 0.0));
    for (std::size_t i = 0; i < size; ++i) {
        const double found = glm::length(vectors[i]);
        if (found > kTiny) {
            directions[i] = vectors[i] / found;
        }
        const double share = std::min(found / length, 1.0);
        own[i] = (kLeastTrust + std::pow(share, power)) * directions[i];
    }
    // Gauss-Seidel: updated in place and normalised, so that a direction is drawn along the sphere
    // from both sides.
    for (int round = 0; round < kRounds; ++round) {
        for (std::size_t i = 0; i < size; ++i) {
            const glm::dvec3 sum =
                own[i] + 0.5 * (directions[(i + size - 1) % size] + directions[(i + 1) % size]);
            const double found = glm::length(sum);
            if (found > kTiny) {
                directions[i] = sum / found;
            }
        }
    }
    return directions;
}

/// Limits the angle between each direction and the learnt one to kFarthestTurned, softly (tanh),
/// along the great circle.
void hold_near(const std::vector<glm::dvec3>& learnt, std::vector<glm::dvec3>& directions) {
    for (std::size_t i = 0; i < learnt.size(); ++i) {
        const glm::dvec3 across = directions[i] - learnt[i] * glm::dot(learnt[i], directions[i]);
        const double sine = glm::length(across);
        if (sine < kTiny) {
            directions[i] = learnt[i];
            continue;
        }
        const double angle = std::atan2(sine, glm::dot(learnt[i], directions[i]));
        const double held = kFarthestTurned * std::tanh(angle / kFarthestTurned);
        directions[i] = std::cos(held) * learnt[i] + (std::sin(held) / sine) * across;
    }
}

/// Component of the lower arm's direction across the upper arm: its length is the sine of the bend.
std::vector<glm::dvec3> asides_of(const std::vector<glm::dvec3>& uppers,
                                  const std::vector<glm::dvec3>& lowers) {
    std::vector<glm::dvec3> asides;
    for (std::size_t i = 0; i < uppers.size(); ++i) {
        asides.push_back(lowers[i] - uppers[i] * glm::dot(uppers[i], lowers[i]));
    }
    return asides;
}

/// The vector from one joint to another by sample.
std::vector<glm::dvec3> vectors_of(const FeatureTrack& track, std::size_t from, std::size_t to) {
    std::vector<glm::dvec3> vectors;
    for (std::size_t i = 0; i < track.rows(); ++i) {
        vectors.push_back(vector_at(track.row(i), to) - vector_at(track.row(i), from));
    }
    return vectors;
}

Arm arm_of(const FeatureTrack& track, const ArmLayout& at) {
    Arm arm;
    arm.uppers = directions_of(vectors_of(track, at.shoulder, at.elbow), at.upper, kBonePower);
    arm.lowers = directions_of(vectors_of(track, at.elbow, at.hand), at.lower, kBonePower);
    arm.sides = directions_of(asides_of(arm.uppers, arm.lowers), 1.0, kBendPower);
    return arm;
}

/// The lower arm's direction, turned so that it bends towards `to_side` by kLeastBend at least.
glm::dvec3 bent(const glm::dvec3& upper, const glm::dvec3& lower, const glm::dvec3& to_side) {
    const double along = glm::dot(upper, lower);
    const glm::dvec3 side = to_side - upper * glm::dot(upper, to_side);
    const double found = glm::length(side);
    if (found < kTiny) {
        return lower;
    }
    const double sine = std::sqrt(std::max(0.0, 1.0 - along * along));
    const double bend = std::min(std::hypot(kLeastBend, sine), 1.0);
    return std::copysign(std::sqrt(1.0 - bend * bend), along) * upper + (bend / found) * side;
}

// Rebuilds elbow and hand from the shoulder outward with the bones' own lengths.
void write_arm(const Arm& arm, const ArmLayout& at, FeatureTrack& track) {
    for (std::size_t i = 0; i < track.rows(); ++i) {
        const std::span<double> row = track.row(i);
        const glm::dvec3 elbow = vector_at(row, at.shoulder) + at.upper * arm.uppers[i];
        const glm::dvec3 hand = elbow + at.lower * bent(arm.uppers[i], arm.lowers[i], arm.sides[i]);
        for (int axis = 0; axis < 3; ++axis) {
            row[at.elbow + static_cast<std::size_t>(axis)] = elbow[axis];
            row[at.hand + static_cast<std::size_t>(axis)] = hand[axis];
        }
    }
}

}  // namespace

void restore_arms(const PartModel& part, const Skeleton& body, FeatureTrack& track) {
    for (const Side side : kSides) {
        const ArmLayout layout = layout_of(part, body, side);
        write_arm(arm_of(track, layout), layout, track);
    }
}

void restore_arms_near(const FeatureTrack& learnt,
                       const PartModel& part,
                       const Skeleton& body,
                       FeatureTrack& track) {
    for (const Side side : kSides) {
        const ArmLayout layout = layout_of(part, body, side);
        const Arm kept = arm_of(learnt, layout);
        Arm arm = arm_of(track, layout);
        hold_near(kept.uppers, arm.uppers);
        hold_near(kept.lowers, arm.lowers);
        hold_near(kept.sides, arm.sides);
        write_arm(arm, layout, track);
    }
}

namespace {

// Distances between palms, metres: below the first they meet; below the second they begin to.
constexpr float kMeeting = 0.08F;
constexpr float kApproach = 0.6F;
// Distance between the middles of two touching palms, and the softness of that limit; metres.
constexpr float kPalms = 0.035F;
constexpr float kMeetingSoft = 0.015F;
constexpr int kMeetingRounds = 2;  // the palm turns with the forearm, so one round falls short

/// Vector from the left palm to the right one, in the chest's frame.
glm::vec3 between_palms(const WorldPose& world) noexcept {
    return glm::conjugate(world.rotation(Bone::upper_chest)) *
           (palm_of(world, Side::right) - palm_of(world, Side::left));
}

/// Weight of the meeting, smootherstep of the distance: 1 when the hands meet, 0 beyond kApproach.
float nearness_of(const glm::vec3& between) noexcept {
    const float t =
        std::clamp((kApproach - glm::length(between)) / (kApproach - kMeeting), 0.0F, 1.0F);
    return t * t * t * (10.0F - t * (15.0F - 6.0F * t));
}

/// The same vector, but with the right palm at least kPalms to the right of the left one (x is
/// left), softly.
glm::vec3 side_by_side(glm::vec3 between) noexcept {
    const float spare = -between.x - kPalms;
    between.x = -kPalms - 0.5F * (spare + std::sqrt(spare * spare + kMeetingSoft * kMeetingSoft));
    return between;
}

// Moves each palm by half of what is missing to `wanted`, weighted by `share`.
void move_hands(const Skeleton& skeleton, const glm::vec3& wanted, float share, Pose& pose) {
    for (int round = 0; round < kMeetingRounds; ++round) {
        const WorldPose world = world_body(skeleton, pose);
        const glm::quat& chest = world.rotation(Bone::upper_chest);
        const glm::vec3 right = chest * (0.5F * share * (wanted - between_palms(world)));
        for (const Side side : kSides) {
            const Limb arm = arm_of(world, side);
            const glm::vec3 way = side == Side::right ? right : -right;
            solve_limb(skeleton, arm, world.position(arm.end) + way, pose);
        }
    }
}

}  // namespace

void meet_hands(const Skeleton& skeleton, std::span<const Pose> learnt, std::span<Pose> varied) {
    std::vector<glm::vec3> between;
    between.reserve(learnt.size());
    for (const Pose& pose : learnt) {
        between.push_back(between_palms(world_body(skeleton, pose)));
    }
    const bool meet = std::any_of(between.begin(), between.end(), [](const glm::vec3& apart) {
        return glm::length(apart) < kMeeting;
    });
    for (std::size_t i = 0; meet && i < std::min(learnt.size(), varied.size()); ++i) {
        const float share = nearness_of(between[i]);
        if (share > 0.0F) {
            move_hands(skeleton, side_by_side(between[i]), share, varied[i]);
        }
    }
}

}  // namespace raks::motion
