#include "motion/dance/baking/arm_directions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// How strongly a sample holds to its own direction against its two neighbours' (1): by a power of
// its share of the whole length, and at least this. By the sixth a bone of 0.9 of its length is
// smoothed over a sample or two and one of 0.3 over a third of a beat.
constexpr double kLeastTrust = 0.01;
constexpr int kBonePower = 6;
constexpr int kBendPower = 2;
constexpr int kRounds = 150;
constexpr double kTiny = 1e-6;
// Sine of the least bend of an elbow. Straighter, its plane, and with it the turn of the upper arm
// about itself, would be noise; people's elbows hardly ever are.
constexpr double kLeastBend = 0.25;
constexpr double kFarthest = 0.5;  // radians of a varied arm's bones from where they were learnt

/// Where a joint's three numbers begin in a row.
std::size_t column_of(const PartModel& part, Bone bone) {
    const auto joint = std::find_if(
        part.joints.begin(), part.joints.end(), [bone](const auto& j) { return j.bone == bone; });
    return part.root_features() + 3 * static_cast<std::size_t>(joint - part.joints.begin());
}

/// Where one arm lies in a row, and how long it is.
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

/// Unit directions over the figure: of both bones, and to which side the elbow bends.
struct Arm {
    std::vector<glm::dvec3> uppers;
    std::vector<glm::dvec3> lowers;
    std::vector<glm::dvec3> sides;
};

glm::dvec3 vector_at(std::span<const double> row, std::size_t at) {
    return {row[at], row[at + 1], row[at + 2]};
}

/// Directions of vectors, at most about `length` long, that go on steadily where those say little.
std::vector<glm::dvec3> directions_of(const std::vector<glm::dvec3>& vectors,
                                      double length,
                                      int power) {
    const std::size_t size = vectors.size();
    std::vector<glm::dvec3> own(size);  // weighed by trust
    std::vector<glm::dvec3> directions(size, glm::dvec3(0.0, -1.0, 0.0));
    for (std::size_t i = 0; i < size; ++i) {
        const double found = glm::length(vectors[i]);
        if (found > kTiny) {
            directions[i] = vectors[i] / found;
        }
        const double share = std::min(found / length, 1.0);
        own[i] = (kLeastTrust + std::pow(share, power)) * directions[i];
    }
    // In place, so that a direction is drawn along the sphere from both sides (Gauss-Seidel).
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

/// Draws unit directions towards those learnt, softly, so that no pair is further apart than
/// kFarthest.
void hold_near(const std::vector<glm::dvec3>& learnt, std::vector<glm::dvec3>& directions) {
    for (std::size_t i = 0; i < learnt.size(); ++i) {
        const glm::dvec3 across = directions[i] - learnt[i] * glm::dot(learnt[i], directions[i]);
        const double sine = glm::length(across);
        if (sine < kTiny) {
            directions[i] = learnt[i];
            continue;
        }
        const double angle = std::atan2(sine, glm::dot(learnt[i], directions[i]));
        const double held = kFarthest * std::tanh(angle / kFarthest);
        directions[i] = std::cos(held) * learnt[i] + (std::sin(held) / sine) * across;
    }
}

/// How far the lower arm stands out from the upper arm's line.
std::vector<glm::dvec3> asides_of(const std::vector<glm::dvec3>& uppers,
                                  const std::vector<glm::dvec3>& lowers) {
    std::vector<glm::dvec3> asides;
    for (std::size_t i = 0; i < uppers.size(); ++i) {
        asides.push_back(lowers[i] - uppers[i] * glm::dot(uppers[i], lowers[i]));
    }
    return asides;
}

/// The bone from one joint to another over the figure.
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

/// The lower arm's direction, bent to its side and a little at least.
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

}  // namespace raks::motion
