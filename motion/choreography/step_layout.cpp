#include "motion/choreography/step_layout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/choreography/splines.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kLandingSpeed = 0.3;  // m/s; landing detection: the foot falls under it...
constexpr double kStepSpeed = 0.6;     // ... after having been faster than this (foot_events.hpp)
constexpr double kLatest = 0.2;        // longest delay of a swing's end, as a share of its air time
constexpr double kInPlace = 0.04;      // metres; a shorter step stays in place
constexpr double kTouchPitch = 28.0 * kDegree;
constexpr double kHeelTouchPitch = -18.0 * kDegree;
constexpr double kSettleTime = 0.28;  // beats after a step until the foot is settled

/// Place and heading of a repeat's figure frame on the floor; calling it takes a place of the
/// figure to the world.
struct FloorFrame {
    glm::dvec2 origin{};
    double yaw = 0.0;

    [[nodiscard]] glm::dvec2 operator()(const glm::dvec2& local) const noexcept {
        const double c = std::cos(yaw);
        const double s = std::sin(yaw);
        return origin + glm::dvec2(c * local.x + s * local.y, c * local.y - s * local.x);
    }
};

// Each foot turns outward: positive yaw is to the left.
double toe_out(const AuthoredFigure& figure, Side side) {
    return (side == Side::left ? 1.0 : -1.0) * figure.style.toe_out * kDegree;
}

// Place of a foot at rest in the figure's frame.
glm::dvec2 stance_of(const AuthoredFigure& figure, Side side) {
    return {(side == Side::left ? 0.5 : -0.5) * figure.style.stance * kCentimetre, 0.0};
}

/// Share of the air time that a swing needs after its detected landing, which is where its speed
/// falls under kLandingSpeed. A swing ends later by this, so that its landing lies on the beat. 0
/// for a step too slow to be detected.
double share_after_landing(double distance, double seconds) {
    constexpr double kPeakOfEase = 1.875;  // peak slope of ease()
    if (kPeakOfEase * distance < kStepSpeed * seconds) {
        return 0.0;
    }
    // The speed of ease() is 30 (s (1 - s))^2 distance / seconds; solved for the later s.
    const double q = std::sqrt(kLandingSpeed * seconds / (30.0 * distance));
    const double s = 0.5 * (1.0 + std::sqrt(1.0 - 4.0 * q));
    return std::min(1.0 - s, kLatest);
}

// Touches rest with heel or toes up; everything else goes flat.
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

/// Pitch to which the heel rises before the foot leaves the floor, more for a longer step.
double peel_pitch(const PlacedStep& step) {
    constexpr double kLeast = 12.0;     // degrees
    constexpr double kPerMetre = 60.0;  // degrees a metre
    constexpr double kMost = 40.0;      // degrees
    if (step.slides()) {
        return kLeast * kDegree;
    }
    const double distance = glm::length(step.to - step.from);
    return std::min(kMost, kLeast + kPerMetre * distance) * kDegree;
}

/// The pitch at which the foot leaves: the heel rises less where it stands shorter than kPeelTime.
double leaving_pitch(const PlacedStep* before, const PlacedStep& step) {
    const double rests = settled_pitch(before, step.start);
    const double share = std::clamp(time_standing(before, step) / kPeelTime, 0.0, 1.0);
    return rests + share * (std::max(rests, peel_pitch(step)) - rests);
}

// Walks through all repeats in order, as a step starts where the last one of its foot ended.
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

    StepLayout place() {
        for (int repeat = plan_.first_repeat; repeat <= plan_.last_repeat; ++repeat) {
            for (std::size_t i = 0; i < figure_.steps.size(); ++i) {
                add(figure_.steps[i], i, repeat);
            }
        }
        // Sorted per foot first: repeats may overlap at their ends.
        for (auto& steps : layout_.steps) {
            separate(steps);
        }
        return std::move(layout_);
    }

 private:
    /// The frame of a repeat: travel and turn of all repeats from 0 on applied in order, or undone
    /// for negative ones. Mirrored repeats travel and turn the other way.
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

    /// Air time of a step, beats. That of a jump (both feet at once) is limited in seconds: at a
    /// slow tempo it would be higher than anyone leaps in passing.
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

    /// Places one step of one repeat; the foot's place and yaw go on from here.
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
        place_[s] = target(step, index, repeat, sign, side, frame);
        yaw_[s] = frame.yaw + sign * step.turn * kDegree + toe_out(figure_, side);
        placed.to = place_[s];
        placed.to_yaw = yaw_[s];
        const double distance = glm::length(placed.to - placed.from);
        constexpr double kLeastLift = 2.5;   // cm
        constexpr double kLiftShare = 0.07;  // of the distance, added to the least lift
        placed.lift =
            step.lift ? *step.lift * kCentimetre : kLeastLift * kCentimetre + kLiftShare * distance;
        const double lands = step.at + step.land + repeat * figure_.beats;
        const double air = air_of(step);
        const double seconds = air * plan_.tempo.seconds_per_beat();
        // The detected landing lies at `lands`; the swing ends a little later.
        placed.end = lands + share_after_landing(distance, seconds) * air;
        placed.start = placed.end - air;
        layout_.steps[s].push_back(placed);
        if (step.weight) {
            // The weight shifts around the landing.
            layout_.weights.push_back({0.5 * (lands + placed.end),
                                       side == Side::left ? *step.weight : 1.0 - *step.weight});
        }
    }

    /// Where a step lands, in the world, with noise.
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
        // Only steps of a figure that stays shrink with the tempo; others would not fit their
        // travel.
        if (figure_.stays()) {
            const glm::dvec2 stance = stance_of(figure_, side);
            local = stance + plan_.size * (local - stance);
        }
        // A foot that stays in place keeps its noise; otherwise it would wander step by step.
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

    /// Sorts one foot's steps, shortens those that begin before the last one has landed, and sets
    /// the pitch at which each leaves.
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
    StepLayout layout_;
    std::array<glm::dvec2, 2> place_{};    // in the world, by Side
    std::array<glm::dvec2, 2> planned_{};  // the same without noise, by Side
    std::array<glm::dvec2, 2> aside_{};    // noise of the place, by Side
    std::array<bool, 2> has_place_{};      // whether that noise was drawn, by Side
    std::array<double, 2> yaw_{};          // of the toes, by Side
};

}  // namespace

StepLayout place_steps(const RepeatPlan& plan) { return StepPlacer(plan).place(); }

double landing_pitch(FootLanding on) noexcept {
    constexpr double kBallPitch = 16.0 * kDegree;
    constexpr double kFlatPitch = 3.0 * kDegree;
    constexpr double kHeelPitch = -14.0 * kDegree;
    switch (on) {
        case FootLanding::ball:
            return kBallPitch;
        case FootLanding::flat:
            return kFlatPitch;
        case FootLanding::heel:
            return kHeelPitch;
        case FootLanding::touch:
            return kTouchPitch;
        case FootLanding::heel_touch:
            return kHeelTouchPitch;
    }
    return 0.0;
}

double settled_pitch(const PlacedStep* step, double beat) noexcept {
    if (step == nullptr) {
        return 0.0;
    }
    // From the pitch at landing to that at rest.
    const double lands = landing_pitch(step->on);
    const double settled = ease((beat - step->end) / kSettleTime);
    return lands + settled * (resting_pitch(step->on) - lands);
}

double time_standing(const PlacedStep* before, const PlacedStep& step) noexcept {
    return before != nullptr ? step.start - before->end : kPeelTime;
}

}  // namespace raks::motion
