#include "motion/choreography/foot_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "motion/choreography/curves.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kCentimetre = 0.01;
constexpr double kLandingSpeed = 0.3;  // m/s: under it a foot has landed
constexpr double kStepSpeed = 0.6;     // after having been so fast
constexpr double kLatest = 0.2;        // of the time in the air: so much may a swing end later
constexpr double kSlide = 0.01;        // m: a step that rises no more slides
constexpr double kInPlace = 0.04;      // m: a shorter step is one in place
constexpr double kTouchPitch = 28.0 * kDegree;
constexpr double kHeelTouchPitch = -18.0 * kDegree;
constexpr double kSole = 0.065;  // m: the middle of a standing foot lies so far behind its ball

/// Where a repeat's figure frame stands.
struct FloorFrame {
    glm::dvec2 origin{};
    double yaw = 0.0;

    [[nodiscard]] glm::dvec2 operator()(const glm::dvec2& local) const noexcept {
        const double c = std::cos(yaw);
        const double s = std::sin(yaw);
        return origin + glm::dvec2(c * local.x + s * local.y, c * local.y - s * local.x);
    }
};

/// One step of one foot, in the world.
struct PlacedStep {
    double start = 0.0;  // beat at which the foot leaves the floor
    double end = 0.0;    // and rests again
    double air = 0.5;
    glm::dvec2 from{};
    glm::dvec2 to{};
    double from_yaw = 0.0;
    double to_yaw = 0.0;
    double lift = 0.0;  // metres
    FootLanding on = FootLanding::ball;
    double leaves = 0.0;  // pitch when it leaves the floor
};

struct WeightChange {
    double at = 0.0;
    double left = 0.5;
};

struct Layout {
    std::array<std::vector<PlacedStep>, 2> steps;
    std::vector<WeightChange> weights;
    std::array<glm::dvec2, 2> first_place{};
    std::array<double, 2> first_yaw{};
};

double toe_out(const AuthoredFigure& figure, Side side) {
    return (side == Side::left ? 1.0 : -1.0) * figure.style.toe_out * kDegree;
}

glm::dvec2 stance_of(const AuthoredFigure& figure, Side side) {
    return {(side == Side::left ? 0.5 : -0.5) * figure.style.stance * kCentimetre, 0.0};
}

/// Speed falls under kLandingSpeed at the share `s` of the swing; what comes after it is later than
/// the beat.
double share_after_landing(double distance, double seconds) {
    constexpr double kPeakOfEase = 1.875;
    if (kPeakOfEase * distance < kStepSpeed * seconds) {
        return 0.0;
    }
    const double q = std::sqrt(kLandingSpeed * seconds / (30.0 * distance));
    const double s = 0.5 * (1.0 + std::sqrt(1.0 - 4.0 * q));
    return std::min(1.0 - s, kLatest);
}

double resting_pitch(FootLanding on) {
    switch (on) {
        case FootLanding::touch:
            return kTouchPitch;
        case FootLanding::heel_touch:
            return kHeelTouchPitch;
        default:
            return 0.0;
    }
}

double landing_pitch(FootLanding on) {
    constexpr double kBall = 16.0 * kDegree;
    constexpr double kFlat = 3.0 * kDegree;
    constexpr double kHeel = -14.0 * kDegree;
    switch (on) {
        case FootLanding::ball:
            return kBall;
        case FootLanding::flat:
            return kFlat;
        case FootLanding::heel:
            return kHeel;
        case FootLanding::touch:
            return kTouchPitch;
        case FootLanding::heel_touch:
            return kHeelTouchPitch;
    }
    return 0.0;
}

/// The heel rises before the foot leaves the floor, more for a longer step.
double peel_pitch(const PlacedStep& step) {
    constexpr double kLeast = 12.0;
    constexpr double kPerMetre = 60.0;
    constexpr double kMost = 40.0;
    if (step.lift <= kSlide) {
        return kLeast * kDegree;
    }
    const double distance = glm::length(step.to - step.from);
    return std::min(kMost, kLeast + kPerMetre * distance) * kDegree;
}

constexpr double kPeelTime = 0.28;    // beats before a step
constexpr double kSettleTime = 0.28;  // and after it

/// Pitch of a foot on the floor after a step, before the next one is felt.
double settled_pitch(const PlacedStep* step, double beat) {
    if (step == nullptr) {
        return 0.0;
    }
    const double lands = landing_pitch(step->on);
    const double settled = ease((beat - step->end) / kSettleTime);
    return lands + settled * (resting_pitch(step->on) - lands);
}

/// Beats that a foot has on the floor before a step.
double time_standing(const PlacedStep* before, const PlacedStep& step) {
    return before != nullptr ? step.start - before->end : kPeelTime;
}

/// With less time than it needs the heel rises less.
double leaving_pitch(const PlacedStep* before, const PlacedStep& step) {
    const double rests = settled_pitch(before, step.start);
    const double share = std::clamp(time_standing(before, step) / kPeelTime, 0.0, 1.0);
    return rests + share * (std::max(rests, peel_pitch(step)) - rests);
}

class StepPlacer {
 public:
    explicit StepPlacer(const RepeatPlan& plan) : plan_(plan), figure_(*plan.figure) {
        FloorFrame frame = frame_of(plan.first_repeat);
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            place_[s] = layout_.first_place[s] = frame(stance_of(figure_, side));
            yaw_[s] = layout_.first_yaw[s] = frame.yaw + toe_out(figure_, side);
            planned_[s] = stance_of(figure_, side);
        }
    }

    Layout place() {
        for (int repeat = plan_.first_repeat; repeat <= plan_.last_repeat; ++repeat) {
            for (std::size_t i = 0; i < figure_.steps.size(); ++i) {
                add(figure_.steps[i], i, repeat);
            }
        }
        for (auto& steps : layout_.steps) {
            separate(steps);
        }
        return std::move(layout_);
    }

 private:
    /// The frame of a repeat: moved by travel and turn from that of repeat 0 on, and back before.
    [[nodiscard]] FloorFrame frame_of(int repeat) const {
        FloorFrame frame;
        const auto travel = [&](int of) {
            const double side = plan_.is_mirrored(of) ? -1.0 : 1.0;
            return std::pair(kCentimetre * glm::dvec2(side * figure_.travel.x, figure_.travel.y),
                             side * figure_.turn * kDegree);
        };
        for (int r = 0; r < repeat; ++r) {
            const auto [move, turn] = travel(r);
            frame.origin = frame(move);
            frame.yaw += turn;
        }
        for (int r = -1; r >= repeat; --r) {
            const auto [move, turn] = travel(r);
            frame.yaw -= turn;
            frame.origin = FloorFrame{frame.origin, frame.yaw}(-move);
        }
        return frame;
    }

    /// Beats off the floor. A jump, both feet at once, is no longer at a slow tempo: it would be
    /// higher than anyone leaps in passing.
    [[nodiscard]] double air_of(const FootStep& step) const {
        constexpr double kTogether = 0.1;        // beats
        constexpr double kLongestFlight = 0.28;  // seconds: 10 cm
        const bool is_jump =
            std::any_of(figure_.steps.begin(), figure_.steps.end(), [&](const FootStep& other) {
                return other.foot != step.foot && std::abs(other.at - step.at) < kTogether;
            });
        return is_jump ? std::min(step.air, kLongestFlight / plan_.tempo.seconds_per_beat())
                       : step.air;
    }

    void add(const FootStep& step, std::size_t index, int repeat) {
        const bool is_mirrored = plan_.is_mirrored(repeat);
        const Side side =
            is_mirrored ? (step.foot == Side::left ? Side::right : Side::left) : step.foot;
        const double sign = is_mirrored ? -1.0 : 1.0;
        const auto s = static_cast<std::size_t>(side);
        const FloorFrame frame = frame_of(repeat);

        PlacedStep placed;
        placed.from = place_[s];
        placed.from_yaw = yaw_[s];
        placed.on = step.on;
        placed.air = air_of(step);
        place_[s] = target(step, index, repeat, sign, side, frame);
        yaw_[s] = frame.yaw + sign * step.turn * kDegree + toe_out(figure_, side);
        placed.to = place_[s];
        placed.to_yaw = yaw_[s];
        const double distance = glm::length(placed.to - placed.from);
        constexpr double kLeastLift = 2.5;  // cm
        constexpr double kLiftShare = 0.07;
        placed.lift =
            step.lift ? *step.lift * kCentimetre : kLeastLift * kCentimetre + kLiftShare * distance;
        const double lands = step.at + step.land + repeat * figure_.beats;
        const double seconds = placed.air * plan_.tempo.seconds_per_beat();
        placed.end = lands + share_after_landing(distance, seconds) * placed.air;
        placed.start = placed.end - placed.air;
        layout_.steps[s].push_back(placed);
        if (step.weight) {
            layout_.weights.push_back({0.5 * (lands + placed.end),
                                       side == Side::left ? *step.weight : 1.0 - *step.weight});
        }
    }

    glm::dvec2 target(const FootStep& step,
                      std::size_t index,
                      int repeat,
                      double sign,
                      Side side,
                      const FloorFrame& frame) {
        const auto s = static_cast<std::size_t>(side);
        if (!step.to) {
            return place_[s];
        }
        glm::dvec2 local = kCentimetre * glm::dvec2(sign * step.to->x, step.to->y);
        if (figure_.stays()) {
            const glm::dvec2 stance = stance_of(figure_, side);
            local = stance + plan_.size * (local - stance);
        }
        // A foot that stays where it is does not begin to wander.
        const glm::dvec2 wanted = frame(local);
        if (!has_place_[s] || glm::length(wanted - planned_[s]) >= kInPlace) {
            const CounterRandom random = plan_.random(Draw::places, index);
            const double size = plan_.noise * figure_.style.vary_cm * kCentimetre;
            aside_[s] = size * glm::dvec2(random.normal(RepeatPlan::number_of(repeat, 0)),
                                          random.normal(RepeatPlan::number_of(repeat, 1)));
            has_place_[s] = true;
        }
        planned_[s] = wanted;
        return wanted + aside_[s];
    }

    /// A foot leaves the floor no sooner than it has landed, and as it stood.
    static void separate(std::vector<PlacedStep>& steps) {
        std::stable_sort(
            steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.end < b.end; });
        for (std::size_t i = 1; i < steps.size(); ++i) {
            steps[i].start = std::max(steps[i].start, steps[i - 1].end);
        }
        for (std::size_t i = 0; i < steps.size(); ++i) {
            steps[i].leaves = leaving_pitch(i > 0 ? &steps[i - 1] : nullptr, steps[i]);
        }
    }

    const RepeatPlan& plan_;
    const AuthoredFigure& figure_;
    Layout layout_;
    std::array<glm::dvec2, 2> place_{};    // in the world, by Side
    std::array<glm::dvec2, 2> planned_{};  // the same without noise
    std::array<glm::dvec2, 2> aside_{};
    std::array<bool, 2> has_place_{};
    std::array<double, 2> yaw_{};
};

/// The steps around a beat: the one that is under way or was last, and the next.
struct StepsAround {
    const PlacedStep* now = nullptr;   // begun
    const PlacedStep* next = nullptr;  // not yet
};

StepsAround steps_around(const std::vector<PlacedStep>& steps, double beat) {
    const auto next = std::find_if(
        steps.begin(), steps.end(), [&](const PlacedStep& one) { return one.start > beat; });
    StepsAround around;
    around.next = next != steps.end() ? &*next : nullptr;
    around.now = next != steps.begin() ? &*(next - 1) : nullptr;
    return around;
}

/// Pitch of a foot on the floor, between its steps.
double standing_pitch(const StepsAround& around, double beat) {
    const double pitch = settled_pitch(around.now, beat);
    if (around.next == nullptr) {
        return pitch;
    }
    const PlacedStep& next = *around.next;
    constexpr double kAtOnce = 1e-6;
    const double time = std::clamp(time_standing(around.now, next), kAtOnce, kPeelTime);
    const double peeled = ease(1.0 - (next.start - beat) / time);
    return pitch + peeled * (next.leaves - settled_pitch(around.now, next.start));
}

void set_swing(const PlacedStep& step, double beat, PlannedFoot& foot) {
    const double u = std::clamp((beat - step.start) / (step.end - step.start), 0.0, 1.0);
    const double moved = ease(u);
    foot.is_swinging = true;
    foot.is_lifted = step.lift > kSlide;
    foot.ball = step.from + moved * (step.to - step.from);
    foot.yaw = step.from_yaw + moved * (step.to_yaw - step.from_yaw);
    foot.height = step.lift * 16.0 * u * u * (1.0 - u) * (1.0 - u) * (1.0 + (u - 0.5) / 4.0);
    foot.pitch = step.leaves + moved * (landing_pitch(step.on) - step.leaves);
}

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

/// Share of a change that has happened: a Hann window's integral.
double hann_step(double s) {
    s = std::clamp(s, -0.5, 0.5);
    return 0.5 + s + std::sin(2.0 * M_PI * s) / (2.0 * M_PI);
}

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

void set_support(const RepeatPlan& plan, FootPlan& feet) {
    constexpr double kSupportBlur = 0.07;  // beats
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
    // The joint of the toes over the ball: about it the foot rolls while the toes stay flat.
    const glm::dvec3 ball_local = foot_local(skeleton.offsets[index_of(Bone::left_toes)], side);
    const double over_floor = ball_local.y - static_cast<double>(skeleton.ball.y);
    const glm::dvec3 ball{foot.ball.x, over_floor + foot.height, foot.ball.y};
    const double pitch = foot.pitch + extra_pitch;
    if (pitch >= 0.0) {
        return ball - foot_rotation(foot.yaw, pitch) * ball_local;
    }
    const glm::dvec3 heel_local = foot_local(skeleton.heel, side);
    const glm::dvec3 heel = ball + foot_rotation(foot.yaw, 0.0) * (heel_local - ball_local);
    return heel - foot_rotation(foot.yaw, pitch) * heel_local;
}

FootPlan plan_feet(const RepeatPlan& plan) {
    const Layout layout = StepPlacer(plan).place();
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
