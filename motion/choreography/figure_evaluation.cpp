#include "motion/choreography/figure_evaluation.hpp"

#include <algorithm>
#include <cmath>

#include "motion/choreography/body_angles.hpp"
#include "motion/choreography/foot_plan.hpp"
#include "motion/choreography/limb_frames.hpp"
#include "motion/choreography/splines.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kGravity = 9.81;  // m/s^2

// One evaluation: feet and angles are fixed by the plan; the hips' place and height are found in
// rounds.
class Evaluation {
 public:
    Evaluation(const AuthoredFigure& figure,
               const Skeleton& skeleton,
               const EvaluationOptions& options)
        : plan_(plan_repeats(figure, options)),
          feet_(plan_feet(plan_)),
          frames_(body_frames(plan_, feet_)),
          skeleton_(skeleton),
          legs_(leg_lengths(skeleton)),
          hips_(plan_.frames()),
          poses_(plan_.frames()) {
        for (const BodyFrame& frame : frames_) {
            pelvis_.push_back(glm::angleAxis(frame.facing, glm::dvec3(0, 1, 0)) *
                              frame.pelvis.rotation());
        }
        for (auto& lift : heel_lift_) {
            lift.assign(plan_.frames(), 0.0);
        }
    }

    void run() {
        constexpr int kRounds = 3;  // of balance; each moves the mass less
        set_upper_bodies();
        place_hips();
        fly();
        // Balance shifts the hips sideways, which changes their height and the heels, so both are
        // solved again.
        for (int round = 0; round < kRounds; ++round) {
            solve_heights();
            peel_heels();
            set_hips_and_legs();
            balance();
        }
        solve_heights();
        peel_heels();
        set_hips_and_legs();
    }

    [[nodiscard]] std::vector<Pose>& poses() noexcept { return poses_; }

    /// The farthest miss of each foot and quarter beat, over all repeats.
    [[nodiscard]] std::vector<ReachMiss> misses() const {
        constexpr double kLeast = 0.005;  // metres
        std::vector<ReachMiss> misses;
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            std::vector<double> worst(static_cast<std::size_t>(plan_.figure->beats) * 4, 0.0);
            for (std::size_t i = 0; i < plan_.frames(); ++i) {
                const double beats = plan_.figure->beats;
                const double beat = plan_.beats[i] - beats * std::floor(plan_.beats[i] / beats);
                const auto quarter =
                    std::min(static_cast<std::size_t>(4.0 * beat), worst.size() - 1);
                const PlannedFoot& foot = feet_.feet[s][i];
                const double far =
                    foot.is_swinging ? 0.0 : distance(i, side, heel_lift_[s][i]) - legs_.reach();
                worst[quarter] = std::max(worst[quarter], far);
            }
            for (std::size_t q = 0; q < worst.size(); ++q) {
                if (worst[q] > kLeast) {
                    misses.push_back({side, static_cast<double>(q) / 4.0, worst[q]});
                }
            }
        }
        return misses;
    }

 private:
    /// A floor vector given as left and forward of the body's front.
    [[nodiscard]] glm::dvec2 turned(std::size_t i, double left, double forward) const {
        const double c = std::cos(frames_[i].facing);
        const double s = std::sin(frames_[i].facing);
        return {c * left + s * forward, c * forward - s * left};
    }
    /// Distance from hip joint to ankle at frame i; metres.
    [[nodiscard]] double distance(std::size_t i, Side side, double extra_pitch) const {
        const PlannedFoot& foot = feet_.feet[static_cast<std::size_t>(side)][i];
        return glm::distance(hip_joint(skeleton_, side, pelvis_[i], hips_[i]),
                             ankle_of(skeleton_, side, foot, extra_pitch));
    }

    /// First guess of the hips: over the support, shifted as written.
    void place_hips() {
        for (std::size_t i = 0; i < hips_.size(); ++i) {
            const glm::dvec3& shift = frames_[i].hip_shift;
            const glm::dvec2 place = feet_.support[i] + turned(i, shift.x, shift.z);
            hips_[i] = {place.x, 0.0, place.y};
        }
    }

    /// Height of the hips at which the ankle of `side` is `length` from its hip joint (Pythagoras).
    [[nodiscard]] double height_for(std::size_t i,
                                    Side side,
                                    double length,
                                    const PlannedFoot& foot) const {
        const glm::dvec3 ankle = ankle_of(skeleton_, side, foot);
        const glm::dvec3 joint =
            hip_joint(skeleton_, side, pelvis_[i], {hips_[i].x, 0, hips_[i].z});
        const double dx = ankle.x - joint.x;
        const double dz = ankle.z - joint.z;
        constexpr double kLowest = 0.3;  // of the leg: no lower than sitting on the heels
        const double up = std::sqrt(
            std::max(kLowest * kLowest * length * length, length * length - dx * dx - dz * dz));
        return ankle.y + up - joint.y;
    }

    /// The planned foot; a swinging one as if it stood, so that a swing does not lift the body.
    [[nodiscard]] PlannedFoot standing(std::size_t i, Side side) const {
        PlannedFoot foot = feet_.feet[static_cast<std::size_t>(side)][i];
        if (foot.is_swinging) {
            foot.pitch = foot.heel;
            foot.height = 0.0;
        }
        return foot;
    }

    /// Heights of the hips: those at which the carrying knees have their bend, weighted between
    /// both legs, smoothed, limited, plus the flight.
    void solve_heights() {
        constexpr double kHeightBlur = 0.05;  // beats
        std::vector<double> height;
        // Eased, so that the height is smooth where all weight reaches one foot.
        for (std::size_t i = 0; i < hips_.size(); ++i) {
            const double length = legs_.at_bend(frames_[i].knee);
            const double left = ease(feet_.weight[i]);
            height.push_back(left * height_for(i, Side::left, length, standing(i, Side::left)) +
                             (1.0 - left) *
                                 height_for(i, Side::right, length, standing(i, Side::right)));
        }
        height = blurred(height, plan_.frames_of(kHeightBlur));
        for (std::size_t i = 0; i < hips_.size(); ++i) {
            // The written hip.y comes after smoothing, the cap after it: it must hold in the end.
            height[i] = capped(i, height[i] + frames_[i].hip_shift.y);
        }
        for (std::size_t i = 0; i < hips_.size(); ++i) {
            hips_[i].y = height[i] + flight_[i];
        }
    }

    /// Limits the height so that no leg is stretched: each knee keeps kLeastBend, softly. A foot
    /// without weight may raise its heel instead.
    [[nodiscard]] double capped(std::size_t i, double height) const {
        constexpr double kLeastBend = 13.0 * kDegree;
        constexpr double kSoft = 0.01;  // metres
        constexpr double kHeelUp = 40.0 * kDegree;
        const double length = legs_.at_bend(kLeastBend);
        for (const Side side : kSides) {
            PlannedFoot foot = feet_.feet[static_cast<std::size_t>(side)][i];
            // The flight lifts hips and feet alike, so it is left out here.
            foot.height -= foot.is_swinging ? flight_[i] : 0.0;
            const double weight = side == Side::left ? feet_.weight[i] : 1.0 - feet_.weight[i];
            foot.pitch = std::max(foot.pitch, kHeelUp * (1.0 - weight));
            height = soft_least(height, height_for(i, side, length, foot), kSoft);
        }
        return height;
    }

    /// While both feet are off the floor, the body and both feet rise and fall in free flight.
    void fly() {
        constexpr double kBlur = 0.02;  // seconds
        flight_ = blurred(flight_heights(), kBlur * plan_.frames_per_second);
        for (auto& feet : feet_.feet) {
            for (std::size_t i = 0; i < feet.size(); ++i) {
                feet[i].height += feet[i].is_swinging ? flight_[i] : 0.0;
            }
        }
    }

    /// Height of free flight by frame: a parabola g t (T - t) / 2 over each stretch in which both
    /// feet are lifted.
    [[nodiscard]] std::vector<double> flight_heights() const {
        std::vector<double> heights(hips_.size(), 0.0);
        const auto is_flying = [&](std::size_t i) {
            return std::all_of(feet_.feet.begin(), feet_.feet.end(), [&](const auto& feet) {
                return feet[i].is_lifted;
            });
        };
        for (std::size_t i = 0; i < hips_.size();) {
            std::size_t end = i;
            while (end < hips_.size() && is_flying(end)) {
                ++end;
            }
            const double seconds = static_cast<double>(end - i) / plan_.frames_per_second;
            for (std::size_t k = i; k < end; ++k) {
                const double t = (static_cast<double>(k - i) + 0.5) / plan_.frames_per_second;
                heights[k] = 0.5 * kGravity * t * (seconds - t);
            }
            i = std::max(end, i + 1);
        }
        return heights;
    }

    /// Lifts the heel of each standing foot by the least angle that brings its ankle within reach.
    void peel_heels() {
        constexpr double kBlur = 0.035;  // seconds
        for (const Side side : kSides) {
            const auto s = static_cast<std::size_t>(side);
            for (std::size_t i = 0; i < hips_.size(); ++i) {
                const bool reaches = distance(i, side, 0.0) <= legs_.reach();
                heel_lift_[s][i] =
                    feet_.feet[s][i].is_swinging || reaches ? 0.0 : lift_for(i, side);
            }
            heel_lift_[s] = blurred(heel_lift_[s], kBlur * plan_.frames_per_second);
        }
    }

    /// Least heel lift with which the leg reaches the ankle, by bisection; at most 60 degrees. The
    /// distance falls as the heel rises.
    [[nodiscard]] double lift_for(std::size_t i, Side side) const {
        constexpr double kMost = 60.0 * kDegree;
        constexpr int kHalvings = 24;
        const PlannedFoot& foot = feet_.feet[static_cast<std::size_t>(side)][i];
        const glm::dvec3 joint = hip_joint(skeleton_, side, pelvis_[i], hips_[i]);
        double low = 0.0;
        double high = kMost;
        for (int h = 0; h < kHalvings; ++h) {
            const double middle = 0.5 * (low + high);
            const double far = glm::distance(joint, ankle_of(skeleton_, side, foot, middle));
            (far > legs_.reach() ? low : high) = middle;
        }
        return high;
    }

    /// Solves trunks and arms, which the place of the hips does not change.
    void set_upper_bodies() {
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            set_trunk(skeleton_, frames_[i], hips_[i], poses_[i]);
            for (const Side side : kSides) {
                set_arm(skeleton_, side, frames_[i], poses_[i]);
            }
        }
    }

    /// Solves the legs between the hips and the feet.
    void set_hips_and_legs() {
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            poses_[i].hips_position = glm::vec3(hips_[i]);
            for (const Side side : kSides) {
                const auto s = static_cast<std::size_t>(side);
                set_leg(skeleton_, side, feet_.feet[s][i], heel_lift_[s][i], poses_[i]);
            }
        }
    }

    /// Moves the hips so that the centre of mass comes over the support; of a written hip shift
    /// half stays.
    void balance() {
        constexpr double kBlur = 0.18;      // beats; balance is slow
        constexpr double kOnPurpose = 0.5;  // share of the written shift that counts as wanted
        std::vector<double> x;
        std::vector<double> z;
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const glm::dvec3 mass = centre_of_mass(skeleton_, poses_[i]);
            const glm::dvec3& shift = frames_[i].hip_shift;
            const glm::dvec2 wanted = feet_.support[i] + kOnPurpose * turned(i, shift.x, shift.z);
            x.push_back(mass.x - wanted.x);
            z.push_back(mass.z - wanted.y);
        }
        x = blurred(x, plan_.frames_of(kBlur));
        z = blurred(z, plan_.frames_of(kBlur));
        const double share = plan_.figure->style.balance;
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            hips_[i].x -= share * x[i];
            hips_[i].z -= share * z[i];
        }
    }

    RepeatPlan plan_;
    FootPlan feet_;
    std::vector<BodyFrame> frames_;
    std::vector<glm::dquat> pelvis_;  // rotation in the world, by frame
    const Skeleton& skeleton_;
    LegLengths legs_;
    std::vector<glm::dvec3> hips_;
    std::vector<double> flight_;  // height of hips and feet in free flight, by frame; metres
    std::array<std::vector<double>, 2> heel_lift_;  // by Side and frame; radians
    std::vector<Pose> poses_;
};

}  // namespace

EvaluatedFigure evaluate_figure(const AuthoredFigure& figure,
                                const Skeleton& skeleton,
                                const EvaluationOptions& options) {
    Evaluation evaluation(figure, skeleton, options);
    evaluation.run();
    EvaluatedFigure evaluated;
    evaluated.misses = evaluation.misses();
    evaluated.poses = std::move(evaluation.poses());
    evaluated.frames_per_second = options.frames_per_second;
    evaluated.beats_per_frame = options.tempo.beats_per_second() / options.frames_per_second;
    evaluated.first_beat = -options.margin;
    evaluated.beats = figure.beats;
    evaluated.repeats = options.repeats;
    return evaluated;
}

}  // namespace raks::motion
