#include "motion/skeleton/body/bone_twist.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "base/statistics.hpp"

namespace raks::motion {
namespace {

/// The bones of a bent limb, and the axis about which it bends in the T-pose of the left side.
struct Hinge {
    Bone upper;
    Bone lower;
    Bone end;
    glm::dvec3 axis;
};

// Of the left elbow.
const glm::dvec3 kUpward(0.0, -std::cos(0.26), std::sin(0.26));

std::optional<Hinge> hinge_of(Bone bone) {
    const bool is_right = index_of(bone) > index_of(mirrored(bone));
    const Side side = is_right ? Side::right : Side::left;
    const Bone left = is_right ? mirrored(bone) : bone;
    if (left == Bone::left_upper_leg || left == Bone::left_lower_leg) {
        // The shin bends backward.
        return Hinge{on_side(Bone::left_upper_leg, side),
                     on_side(Bone::left_lower_leg, side),
                     on_side(Bone::left_foot, side),
                     {1.0, 0.0, 0.0}};
    }
    if (left == Bone::left_upper_arm || left == Bone::left_lower_arm) {
        // The forearm bends forward and some 15 degrees up (mean of the dances of eleven people).
        return Hinge{on_side(Bone::left_upper_arm, side),
                     on_side(Bone::left_lower_arm, side),
                     on_side(Bone::left_hand, side),
                     is_right ? -kUpward : kUpward};
    }
    return std::nullopt;
}

}  // namespace

double twist_of(const glm::dquat& rotation, const glm::dvec3& axis) {
    const double along = rotation.x * axis.x + rotation.y * axis.y + rotation.z * axis.z;
    double angle = 2.0 * std::atan2(along, rotation.w);
    if (angle > glm::pi<double>()) {
        angle -= glm::two_pi<double>();
    } else if (angle < -glm::pi<double>()) {
        angle += glm::two_pi<double>();
    }
    return angle;
}

glm::dquat TurnedBody::mean_against(Bone above, const glm::dquat& rest_above, Bone bone) const {
    glm::dquat sum(0.0, 0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < body_->frames(); ++i) {
        const glm::dquat local = rest_above * glm::conjugate(turn(i, above)) * turn(i, bone);
        sum = glm::dot(sum, local) < 0.0 ? sum - local : sum + local;
    }
    const double length = glm::length(sum);
    return length > 1e-9 ? sum / length : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

std::optional<double> TurnedBody::hinge_twist(Bone bone,
                                              const glm::dquat& straight,
                                              const glm::dvec3& direction) const {
    const auto hinge = hinge_of(bone);
    if (!hinge || !body_->has(hinge->upper) || !body_->has(hinge->lower) ||
        !body_->has(hinge->end)) {
        return std::nullopt;
    }
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < body_->frames(); ++i) {
        const glm::dvec3 upper = body_->place(i, hinge->lower) - body_->place(i, hinge->upper);
        const glm::dvec3 lower = body_->place(i, hinge->end) - body_->place(i, hinge->lower);
        const double lengths = glm::length(upper) * glm::length(lower);
        if (lengths > 0.0) {
            // As long as the bend is large: a straight limb says nothing.
            const glm::dvec3 axis = upright_ * (glm::cross(upper, lower) / lengths);
            sum += glm::conjugate(turn(i, bone)) * axis;
        }
    }
    constexpr double kLeastBend = 0.06;  // mean sine
    if (glm::length(sum) < kLeastBend * static_cast<double>(body_->frames())) {
        return std::nullopt;
    }
    const glm::dvec3 found = straight * sum;
    const glm::dvec3 across = found - glm::dot(found, direction) * direction;
    return std::atan2(glm::dot(direction, glm::cross(across, hinge->axis)),
                      glm::dot(across, hinge->axis));
}

double TurnedBody::lean(Bone bone, const glm::dquat& rest) const {
    std::vector<double> leans;
    const glm::dvec3 face = glm::conjugate(rest) * glm::dvec3(0.0, 0.0, 1.0);
    for (std::size_t i = 0; i < body_->frames(); ++i) {
        leans.push_back(std::asin(std::clamp((turn(i, bone) * face).y, -1.0, 1.0)));
    }
    return upper_median(std::move(leans));
}

}  // namespace raks::motion
