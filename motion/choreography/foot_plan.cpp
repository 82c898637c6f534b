#include "motion/choreography/foot_plan.hpp"

#include <algorithm>
#include <cmath>

#include "motion/choreography/splines.hpp"
#include "motion/choreography/step_layout.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kSole = 0.065;  // metres from the ball back to the middle of the sole

/// The steps around a beat of one foot.
struct StepsAround {
    const PlacedStep* now = nullptr;   // under way, or the last one; null: none yet
    const PlacedStep* next = nullptr;  // the first that has not begun; null: none
};

StepsAround steps_around(const std::vector<PlacedStep>& steps, double beat) {
    const auto next = std::find_if(
        steps.begin(), steps.end(), [&](const PlacedStep& one) { return one.start > beat; });
    StepsAround around;
    around.next = next != steps.end() ? &*next : nullptr;
    around.now = next != steps.begin() ? &*(next - 1) : nullptr;
    return around;
}

/// Pitch of a foot on the floor: settles after the last step, then peels to the pitch at which the
/// next one leaves.
double standing_pitch(const StepsAround& around, double beat) {
    const double pitch = settled_pitch(around.now, beat);
    if (around.next == nullptr) {
        return pitch;
    }
    const PlacedStep& next = *around.next;
    constexpr double kAtOnce = 1e-6;  // beats, against division by zero
    const double time = std::clamp(time_standing(around.now, next), kAtOnce, kPeelTime);
    const double peeled = ease(1.0 - (next.start - beat) / time);
    return pitch + peeled * (next.leaves - settled_pitch(around.now, next.start));
}

// Place, yaw and pitch follow ease(); the height is a bump whose peak lies a little after the
// middle.
void set_swing(const PlacedStep& step, double beat, PlannedFoot& foot) {
    const double u = std::clamp((beat - step.start) / (step.end - step.start), 0.0, 1.0);
    const double moved = ease(u);
    foot.is_swinging = true;
    foot.is_lifted = !step.slides();
    foot.ball = step.from + moved * (step.to - step.from);
    foot.yaw = step.from_yaw + moved * (step.to_yaw - step.from_yaw);
    foot.height = step.lift * 16.0 * u * u * (1.0 - u) * (1.0 - u) * (1.0 + (u - 0.5) / 4.0);
    foot.pitch = step.leaves + moved * (landing_pitch(step.on) - step.leaves);
}

// One foot at one beat; before its first step it stands at the first place.
PlannedFoot foot_at(const std::vector<PlacedStep>& steps,
                    double beat,
                    double heel,
                    const glm::dvec2& first_place,
                    double first_yaw) {
    const StepsAround around = steps_around(steps, beat);
    PlannedFoot foot;
    foot.ball = first_place;
    foot.yaw = first_yaw;
    if (around.now != nullptr && beat < around.now->end) {
        set_swing(*around.now, beat, foot);
    } else {
        if (around.now != nullptr) {
            foot.ball = around.now->to;
            foot.yaw = around.now->to_yaw;
        }
        foot.pitch = standing_pitch(around, beat);
    }
    foot.pitch += heel;
    foot.heel = heel;
    return foot;
}

/// Share of a weight change that has happened, s from -0.5 to 0.5: integral of a Hann window.
double hann_step(double s) {
    s = std::clamp(s, -0.5, 0.5);
    return 0.5 + s + std::sin(2.0 * M_PI * s) / (2.0 * M_PI);
}

// Weight on the left foot by frame: the changes are added in order of time, so overlapping ones
// blend.
std::vector<double> weight_of(const RepeatPlan& plan, std::vector<WeightChange> changes) {
    std::stable_sort(
        changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
    std::vector<double> weight;
    for (const double beat : plan.beats) {
        double value = changes.empty() ? 0.5 : changes.front().left;
        for (std::size_t i = 1; i < changes.size(); ++i) {
            const double share = hann_step((beat - changes[i].at) / plan.figure->style.weight_time);
            value += share * (changes[i].left - changes[i - 1].left);
        }
        weight.push_back(std::clamp(value, 0.0, 1.0));
    }
    return weight;
}

glm::dvec2 forward(double yaw) { return {std::sin(yaw), std::cos(yaw)}; }

// The support: between the middle of the stance (over = 0) and the weighted mean of both soles
// (over = 1).
void set_support(const RepeatPlan& plan, FootPlan& feet) {
    constexpr double kSupportBlur = 0.07;  // beats; takes the edges off the swings
    // Beats; the body turns later and more evenly than the feet
    constexpr double kFacingBlur = 0.22;
    const double over = plan.figure->style.over;
    std::vector<double> x;
    std::vector<double> z;
    std::vector<double> facing;
    for (std::size_t i = 0; i < plan.frames(); ++i) {
        const PlannedFoot& left = feet.feet[0][i];
        const PlannedFoot& right = feet.feet[1][i];
        const glm::dvec2 l = left.ball - kSole * forward(left.yaw);
        const glm::dvec2 r = right.ball - kSole * forward(right.yaw);
        const double w = feet.weight[i];
        const glm::dvec2 support = over * (w * l + (1.0 - w) * r) + (1.0 - over) * 0.5 * (l + r);
        x.push_back(support.x);
        z.push_back(support.y);
        facing.push_back(0.5 * (left.yaw + right.yaw));
    }
    x = blurred(x, plan.frames_of(kSupportBlur));
    z = blurred(z, plan.frames_of(kSupportBlur));
    feet.facing = blurred(facing, plan.frames_of(kFacingBlur));
    for (std::size_t i = 0; i < plan.frames(); ++i) {
        feet.support.emplace_back(x[i], z[i]);
    }
}

// The skeleton's foot points are those of the left foot.
glm::dvec3 foot_local(glm::vec3 left, Side side) {
    return {side == Side::left ? left.x : -left.x, left.y, left.z};
}

}  // namespace

glm::dquat foot_rotation(double yaw, double pitch) noexcept {
    return glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0));
}

glm::dvec3 ankle_of(const Skeleton& skeleton,
                    Side side,
                    const PlannedFoot& foot,
                    double extra_pitch) noexcept {
    // The foot rolls about the joint of the toes, which lies over the ball, while the toes stay
    // flat.
    const glm::dvec3 ball_local = foot_local(skeleton.offsets[index_of(Bone::left_toes)], side);
    const double over_floor = ball_local.y - static_cast<double>(skeleton.ball.y);
    const glm::dvec3 ball{foot.ball.x, over_floor + foot.height, foot.ball.y};
    const double pitch = foot.pitch + extra_pitch;
    if (pitch >= 0.0) {
        return ball - foot_rotation(foot.yaw, pitch) * ball_local;
    }
    // Toes up: it rolls about the heel, which is where it would be with a flat foot.
    const glm::dvec3 heel_local = foot_local(skeleton.heel, side);
    const glm::dvec3 heel = ball + foot_rotation(foot.yaw, 0.0) * (heel_local - ball_local);
    return heel - foot_rotation(foot.yaw, pitch) * heel_local;
}

FootPlan plan_feet(const RepeatPlan& plan) {
    const StepLayout layout = place_steps(plan);
    FootPlan feet;
    feet.weight = weight_of(plan, layout.weights);
    for (const Side side : kSides) {
        const auto s = static_cast<std::size_t>(side);
        const std::vector<double> heels = control_values(plan, on_side(Control::left_heel, side));
        for (std::size_t i = 0; i < plan.frames(); ++i) {
            feet.feet[s].push_back(foot_at(layout.steps[s],
                                           plan.beats[i],
                                           std::max(0.0, heels[i]) * kDegree,
                                           layout.first_place[s],
                                           layout.first_yaw[s]));
        }
    }
    set_support(plan, feet);
    return feet;
}

}  // namespace raks::motion
