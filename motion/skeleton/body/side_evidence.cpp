#include "motion/skeleton/body/side_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/statistics.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

/// A vector of length 1; zero where it has no length.
glm::dvec3 direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 1e-12 ? v / length : glm::dvec3(0.0);
}

/// The places of a body's bones in one frame.
class BodyFrame {
 public:
    BodyFrame(const PosedSkeleton& skeleton, const HumanoidMapping& mapping, std::size_t frame)
        : skeleton_(skeleton), mapping_(mapping), frame_(frame) {}

    glm::dvec3 place(Bone bone) const {
        return skeleton_.place(frame_, static_cast<int>(*mapping_.joint(bone)));
    }
    glm::dvec3 middle(Bone left) const { return 0.5 * (place(left) + place(mirrored(left))); }
    glm::dvec3 across(Bone left) const { return place(left) - place(mirrored(left)); }
    glm::dvec3 up() const {
        return direction(middle(Bone::left_upper_arm) - middle(Bone::left_upper_leg));
    }
    /// Where it would face if its left were on its left: x cross y is z.
    glm::dvec3 forward() const { return direction(glm::cross(across(Bone::left_upper_leg), up())); }
    /// How far the middle joint of a limb is off the line from its first to its last.
    glm::dvec3 bend(Bone upper, Bone lower, Bone last) const {
        const glm::dvec3 line = place(last) - place(upper);
        const glm::dvec3 way = place(lower) - place(upper);
        const double squared = glm::dot(line, line);
        return squared > 0.0 ? way - line * (glm::dot(way, line) / squared) : glm::dvec3(0.0);
    }
    /// From the ankle to the tip of the foot; zero where the clip has none.
    glm::dvec3 foot(Side side) const {
        const Bone ankle = on_side(Bone::left_foot, side);
        if (const auto toes = mapping_.joint(on_side(Bone::left_toes, side))) {
            return skeleton_.place(frame_, static_cast<int>(*toes)) - place(ankle);
        }
        return skeleton_.tip(frame_, static_cast<int>(*mapping_.joint(ankle))) - place(ankle);
    }

 private:
    const PosedSkeleton& skeleton_;
    const HumanoidMapping& mapping_;
    std::size_t frame_;
};

/// Sums of what one kind of joint says.
struct Voice {
    double forward = 0.0;
    double all = 0.0;
    void add(const glm::dvec3& vector, const glm::dvec3& forward_axis) {
        forward += glm::dot(vector, forward_axis);
        all += glm::length(vector);
    }
    double says() const { return all > 0.0 ? forward / all : 0.0; }
};

/// Of the finite ones; files may hold numbers whose squares are not.
double median(std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values.empty() ? 0.0 : nth_value(values, values.size() / 2);
}

}  // namespace

SideEvidence side_evidence(const PosedSkeleton& skeleton, const HumanoidMapping& mapping) {
    Voice feet;
    Voice knees;
    Voice elbows;
    double limb = 0.0;  // sum of leg lengths, to tell a bend from rounding
    for (std::size_t frame = 0; frame < skeleton.frames(); ++frame) {
        const BodyFrame body(skeleton, mapping, frame);
        const glm::dvec3 forward = body.forward();
        for (const Side side : kSides) {
            const auto bend = [&](Bone upper, Bone lower, Bone last) {
                return body.bend(on_side(upper, side), on_side(lower, side), on_side(last, side));
            };
            const glm::dvec3 foot = body.foot(side);
            feet.add(foot, forward);
            knees.add(bend(Bone::left_upper_leg, Bone::left_lower_leg, Bone::left_foot), forward);
            elbows.add(-bend(Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand), forward);
            limb += glm::length(body.place(on_side(Bone::left_upper_leg, side)) -
                                body.place(on_side(Bone::left_foot, side)));
        }
    }
    SideEvidence evidence{
        .feet = feet.says(), .knees = knees.says(), .elbows = elbows.says(), .verdict = 0.0};
    if (!(limb > 0.0)) {
        return evidence;
    }
    // A voice counts in full from a foot of a tenth, or a bend of a twentieth of the leg on.
    const auto weight = [&](const Voice& voice, double full, double most) {
        return most * std::min(1.0, voice.all / limb / full);
    };
    const double of_feet = weight(feet, 0.1, 2.0);
    const double of_knees = weight(knees, 0.05, 1.5);
    const double of_elbows = weight(elbows, 0.05, 0.5);
    const double all = std::max(1.0, of_feet + of_knees + of_elbows);
    evidence.verdict =
        (of_feet * evidence.feet + of_knees * evidence.knees + of_elbows * evidence.elbows) / all;
    return evidence;
}

double arms_beside_legs(const PosedSkeleton& skeleton, const HumanoidMapping& mapping) {
    std::vector<double> beside;
    for (std::size_t frame = 0; frame < skeleton.frames(); ++frame) {
        const BodyFrame body(skeleton, mapping, frame);
        beside.push_back(glm::dot(direction(body.across(Bone::left_upper_leg)),
                                  direction(body.across(Bone::left_upper_arm))));
    }
    return median(std::move(beside));
}

bool goes_on_four(const PosedSkeleton& skeleton, const HumanoidMapping& mapping) {
    if (!mapping.joint(Bone::left_hand) || !mapping.joint(Bone::right_hand)) {
        return false;
    }
    constexpr double kLeastUpright =
        0.4;                            // cosine: the trunk 66 degrees or more off the legs' line
    constexpr double kBothDown = 0.7;   // cosine between arms and legs
    constexpr double kSameFloor = 0.4;  // of the legs: hands and feet at one height
    std::vector<double> upright;
    std::vector<double> alike;
    std::vector<double> apart;
    for (std::size_t frame = 0; frame < skeleton.frames(); ++frame) {
        const BodyFrame body(skeleton, mapping, frame);
        const glm::dvec3 legs = body.middle(Bone::left_foot) - body.middle(Bone::left_upper_leg);
        const glm::dvec3 arms = body.middle(Bone::left_hand) - body.middle(Bone::left_upper_arm);
        const glm::dvec3 down = direction(legs);
        upright.push_back(-glm::dot(body.up(), down));
        alike.push_back(glm::dot(direction(arms), down));
        const double lower =
            glm::dot(body.middle(Bone::left_hand) - body.middle(Bone::left_foot), down);
        apart.push_back(std::abs(lower) / std::max(1e-12, glm::length(legs)));
    }
    return median(std::move(upright)) < kLeastUpright && median(std::move(alike)) > kBothDown &&
           median(std::move(apart)) < kSameFloor;
}

}  // namespace raks::motion
