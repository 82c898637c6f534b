#include "motion/skeleton/body/t_pose_check.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raks::motion {
namespace {

constexpr double kPerDegree = glm::pi<double>() / 180.0;

class Check {
 public:
    Check(const PosedBody& body, const glm::dquat& figure)
        : body_(body), places_(rest_positions(body.clip())) {
        for (glm::dvec3& place : places_) {
            place = figure * place;
        }
        turns_.assign(places_.size(), figure);
    }

    // Whether a bone points where it should; joints that are missing or lie in one place do not say
    // no.
    bool is_along(Bone from, Bone to, const glm::dvec3& direction, double degrees) const {
        if (!body_.has(from) || !body_.has(to)) {
            return true;
        }
        const glm::dvec3 bone = places_[body_.joint(to)] - places_[body_.joint(from)];
        const double length = glm::length(bone);
        return length < 1e-9 || glm::dot(bone, direction) > std::cos(degrees * kPerDegree) * length;
    }

    bool is_trunk_straight() const {
        const glm::dvec3 up(0.0, 1.0, 0.0);
        Bone below = Bone::hips;
        for (const Bone bone :
             {Bone::spine, Bone::chest, Bone::upper_chest, Bone::neck, Bone::head}) {
            if (body_.has(bone)) {
                if (!is_along(below, bone, up, 30.0)) {
                    return false;
                }
                below = bone;
            }
        }
        const auto& tip = body_.clip().joints[body_.joint(below)].end_site;
        return below != Bone::head || !tip || (turns_.front() * *tip).y >= 0.0;
    }

    bool is_leg_straight(Side side) const {
        const glm::dvec3 down(0.0, -1.0, 0.0);
        const Bone thigh = on_side(Bone::left_upper_leg, side);
        const Bone foot = on_side(Bone::left_foot, side);
        const glm::dvec3 toes = toe_tip_of(body_.clip(), body_.mapping(), side, places_, turns_) -
                                places_[body_.joint(foot)];
        return is_along(thigh, foot, down, 10.0) &&
               is_along(thigh, on_side(Bone::left_lower_leg, side), down, 15.0) &&
               toes.z >= 0.3 * glm::length(toes);
    }

    bool is_arm_straight(Side side) const {
        const glm::dvec3 out(side == Side::left ? 1.0 : -1.0, 0.0, 0.0);
        const Bone arm = on_side(Bone::left_upper_arm, side);
        const Bone hand = on_side(Bone::left_hand, side);
        return is_along(arm, hand, out, 12.0) &&
               is_along(arm, on_side(Bone::left_lower_arm, side), out, 15.0) &&
               is_along(on_side(Bone::left_shoulder, side), arm, out, 60.0) &&
               is_along(hand, on_side(Bone::left_middle_proximal, side), out, 35.0);
    }

 private:
    const PosedBody& body_;
    std::vector<glm::dvec3> places_;
    std::vector<glm::dquat> turns_;
};

}  // namespace

bool TPosedLimbs::has(Bone bone) const {
    const bool is_right = index_of(bone) > index_of(mirrored(bone));
    const Bone left = is_right ? mirrored(bone) : bone;
    if (left < Bone::left_upper_leg) {
        return bone != Bone::hips && trunk;
    }
    return left < Bone::left_shoulder ? legs : arms;
}

TPosedLimbs t_posed_limbs(const PosedBody& body, const glm::dquat& figure) {
    const Check check(body, figure);
    TPosedLimbs limbs;
    limbs.trunk = check.is_trunk_straight();
    // A pair at a time, and arms with the trunk: where all bones lie along one axis, one arm does
    // lie sideways.
    limbs.legs = check.is_leg_straight(Side::left) && check.is_leg_straight(Side::right);
    limbs.arms =
        limbs.trunk && check.is_arm_straight(Side::left) && check.is_arm_straight(Side::right);
    return limbs;
}

}  // namespace raks::motion
