#include "motion/choreography/body_angles.hpp"

#include <algorithm>
#include <cmath>

#include "motion/choreography/splines.hpp"

namespace raks::motion {
namespace {

constexpr double kBreathHz = 0.27;  // 16 breaths a minute

using Curve = std::vector<double>;

/// Three angles of a part of the body by frame; radians.
struct AngleCurves {
    Curve yaw;
    Curve roll;
    Curve tilt;

    [[nodiscard]] BodyAngles at(double frame) const noexcept {
        return {value_at(yaw, frame), value_at(roll, frame), value_at(tilt, frame)};
    }
};

/// All controls by frame, converted to radians, metres and shares.
class Controls {
 public:
    explicit Controls(const RepeatPlan& plan) {
        for (std::size_t i = 0; i < kControlCount; ++i) {
            const auto control = static_cast<Control>(i);
            curves_[i] = control_values(plan, control);
            const ControlUnit unit = info_of(control).unit;
            const double scale = unit == ControlUnit::degrees       ? kDegree
                                 : unit == ControlUnit::centimetres ? kCentimetre
                                                                    : 1.0;
            for (double& value : curves_[i]) {
                value *= scale;
            }
        }
    }
    [[nodiscard]] const Curve& operator[](Control control) const noexcept {
        return curves_[index_of(control)];
    }

 private:
    std::array<Curve, kControlCount> curves_;
};

// The pelvis: its controls, turned by the forward foot (step_yaw) and rolled up over the carrying
// foot (sway).
AngleCurves pelvis_curves(const RepeatPlan& plan, const FootPlan& feet, const Controls& controls) {
    const DanceStyle& style = plan.figure->style;
    AngleCurves pelvis{
        controls[Control::hip_yaw], controls[Control::hip_roll], controls[Control::hip_tilt]};
    for (std::size_t i = 0; i < plan.frames(); ++i) {
        const glm::dvec2 apart = feet.feet[0][i].ball - feet.feet[1][i].ball;
        const double facing = feet.facing[i];
        // How far the left foot is ahead of the right one along the body's front; metres.
        const double ahead = std::sin(facing) * apart.x + std::cos(facing) * apart.y;
        pelvis.yaw[i] -= style.step_yaw * kDegree * ahead;
        // From -1 (all weight on the right foot) to 1.
        pelvis.roll[i] += style.sway * kDegree * (2.0 * feet.weight[i] - 1.0);
    }
    return pelvis;
}

// Breathing runs in seconds, not beats: it does not keep time with the music.
double breath_at(const RepeatPlan& plan, std::size_t frame) {
    const double seconds = static_cast<double>(frame) / plan.frames_per_second;
    return plan.figure->style.breath * kDegree * std::sin(2.0 * M_PI * kBreathHz * seconds);
}

/// The chest, led in space: its own controls, the lean, and the share of the pelvis' (lagging)
/// angles that isolation leaves.
AngleCurves chest_curves(const RepeatPlan& plan,
                         const AngleCurves& pelvis,
                         const Controls& controls) {
    constexpr double kRollShare = 0.6;  // the spine takes up much of the hips' roll
    const DanceStyle& style = plan.figure->style;
    const double lag = plan.frames_of(style.lag_chest);
    const double follow = 1.0 - style.iso;
    AngleCurves chest{
        controls[Control::chest_yaw], controls[Control::chest_roll], controls[Control::chest_tilt]};
    for (std::size_t i = 0; i < plan.frames(); ++i) {
        const BodyAngles below = pelvis.at(static_cast<double>(i) - lag);
        chest.yaw[i] += follow * below.yaw;
        chest.roll[i] += follow * kRollShare * below.roll - controls[Control::lean_x][i];
        chest.tilt[i] += follow * below.tilt + controls[Control::lean_z][i] - breath_at(plan, i);
    }
    return chest;
}

// The head follows a share of the chest, later; its roll has no control.
AngleCurves head_curves(const RepeatPlan& plan,
                        const AngleCurves& chest,
                        const Controls& controls) {
    const double lag = plan.frames_of(plan.figure->style.lag_head);
    const double follow = plan.figure->style.head_follow;
    AngleCurves head{
        controls[Control::head_yaw], Curve(plan.frames(), 0.0), controls[Control::head_tilt]};
    for (std::size_t i = 0; i < plan.frames(); ++i) {
        const BodyAngles below = chest.at(static_cast<double>(i) - lag);
        head.yaw[i] += follow * below.yaw;
        head.roll[i] += follow * below.roll;
        head.tilt[i] += follow * below.tilt - 0.5 * breath_at(plan, i);
    }
    return head;
}

// One arm. Shoulders rise with the breath; the hand trails the arm's vertical speed, up to
// kMostDrag.
ArmAngles arm_at(const RepeatPlan& plan, const Controls& controls, Side side, std::size_t i) {
    constexpr double kMostDrag = 28.0 * kDegree;
    const auto value = [&](Control left) { return controls[on_side(left, side)][i]; };
    ArmAngles arm;
    arm.up = value(Control::left_arm_up);
    arm.front = value(Control::left_arm_front);
    arm.bend = std::max(0.0, value(Control::left_arm_bend));
    arm.elbow = value(Control::left_arm_elbow);
    arm.shoulder_up = value(Control::left_shoulder_up) + 0.6 * breath_at(plan, i);
    arm.hand_turn = value(Control::left_hand_turn);
    arm.fist = std::clamp(value(Control::left_hand_fist), 0.0, 1.0);
    const Curve& up = controls[on_side(Control::left_arm_up, side)];
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, up.size() - 1);
    const double speed = (up[after] - up[before]) * plan.frames_per_second /
                         static_cast<double>(std::max<std::size_t>(1, after - before));
    arm.hand_bend = value(Control::left_hand_bend) +
                    kMostDrag * std::tanh(plan.figure->style.drag * speed / kMostDrag);
    return arm;
}

}  // namespace

glm::dquat BodyAngles::rotation() const noexcept {
    return glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(roll, glm::dvec3(0, 0, 1)) *
           glm::angleAxis(tilt, glm::dvec3(1, 0, 0));
}

std::vector<BodyFrame> body_frames(const RepeatPlan& plan, const FootPlan& feet) {
    // Share of the hips' sideways shift that an isolated chest does not follow
    constexpr double kSlideAside = 0.55;
    constexpr double kSlideForward = 0.4;  // the same for shifts forward
    const DanceStyle& style = plan.figure->style;
    const Controls controls(plan);
    const AngleCurves pelvis = pelvis_curves(plan, feet, controls);
    const AngleCurves chest = chest_curves(plan, pelvis, controls);
    const AngleCurves head = head_curves(plan, chest, controls);
    const double arm_lag = plan.frames_of(style.lag_arm);
    std::vector<BodyFrame> frames;
    for (std::size_t i = 0; i < plan.frames(); ++i) {
        const double at = static_cast<double>(i);
        BodyFrame& frame = frames.emplace_back();
        frame.facing = feet.facing[i];
        frame.pelvis = pelvis.at(at);
        frame.chest = chest.at(at);
        frame.head = head.at(at);
        const BodyAngles late = chest.at(at - arm_lag);
        frame.arm_frame = {0.5 * (frame.chest.yaw + late.yaw),
                           0.5 * (frame.chest.roll + late.roll),
                           0.5 * (frame.chest.tilt + late.tilt)};
        frame.hip_shift = {
            controls[Control::hip_x][i], controls[Control::hip_y][i], controls[Control::hip_z][i]};
        frame.chest_slide = {
            controls[Control::chest_x][i] - kSlideAside * style.iso * frame.hip_shift.x,
            controls[Control::chest_z][i] - kSlideForward * style.iso * frame.hip_shift.z};
        frame.knee = std::max(0.0, controls[Control::knee][i]);
        for (const Side side : kSides) {
            frame.arms[static_cast<std::size_t>(side)] = arm_at(plan, controls, side, i);
        }
    }
    return frames;
}

}  // namespace raks::motion
