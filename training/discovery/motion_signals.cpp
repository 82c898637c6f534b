#include "training/discovery/motion_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

constexpr double kShortestMotion = 0.6;  // seconds: two beats of the fastest dance
constexpr double kStillSpeed = 0.05;     // m/s: what the noise of a capture moves a foot or hand
constexpr double kLowPass = 8.0;         // Hz: above the steps of a fast dance, below half the rate
constexpr double kFastFoot = 1.5;  // m/s: faster is as fast, so that a few kicks do not decide
// A small step ends in a landing, too: the limit that figures are judged by (0.6) misses counts 2
// and 6 of the lead's salsa.
constexpr double kSmallStep = 0.35;  // m/s

/// Columns of one kind, which share a scale.
struct Group {
    std::size_t first;
    std::size_t count;
    double weight;   // of the group beside the feet's speed
    double unmoved;  // deviation below which the group counts as noise: m/s or m
};
// Hands weigh little, because in couple dances they follow the hold and not the count.
constexpr std::array<Group, 3> kGroups = {
    {{0, 2, 1.0, 0.10}, {2, 4, 0.7, 0.05}, {6, 6, 0.35, 0.08}}};
constexpr std::size_t kColumns = 12;

/// A point seen from the hips, in their heading: left, up, forward; metres.
glm::dvec3 seen_from_hips(const glm::dvec3& point, const Pose& pose) {
    const glm::dvec3 d = point - glm::dvec3(pose.hips_position);
    const double heading = heading_of(glm::dquat(pose.rotation(Bone::hips)));
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    return {c * d.x - s * d.z, d.y, s * d.x + c * d.z};
}

/// All columns at the clip's own rate, not scaled; one vector a column.
std::array<std::vector<double>, kColumns> columns_of(
    std::span<const Pose> poses, std::span<const std::array<SourceFoot, 2>> feet, double rate) {
    std::array<std::vector<double>, kColumns> columns;
    for (const Side side : kSides) {
        std::vector<double>& speeds = columns[static_cast<std::size_t>(side)];
        speeds = foot_speed(feet, side, rate, kLowPass);
        for (double& speed : speeds) {
            speed = std::min(speed, kFastFoot);
        }
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const WorldPose world = world_pose(mannequin_skeleton(), poses[i]);
        for (const Side side : kSides) {
            const std::size_t s = static_cast<std::size_t>(side);
            const glm::dvec3 ankle = seen_from_hips(feet[i][s].ankle, poses[i]);
            columns[2 + 2 * s].push_back(ankle.x);
            columns[3 + 2 * s].push_back(ankle.z);
            const Bone bone = side == Side::left ? Bone::left_hand : Bone::right_hand;
            const glm::dvec3 hand = seen_from_hips(glm::dvec3(world.position(bone)), poses[i]);
            for (int axis = 0; axis < 3; ++axis) {
                columns[6 + 3 * s + static_cast<std::size_t>(axis)].push_back(hand[axis]);
            }
        }
    }
    return columns;
}

double mean_of(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

/// Values of one column at the signals' rate.
std::vector<double> reduced(std::span<const double> values,
                            double rate,
                            std::span<const double> taps,
                            std::size_t rows) {
    const std::vector<double> smooth = filtered(values, taps);
    std::vector<double> result(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const double at = std::min(static_cast<double>(row) / kSignalRate * rate,
                                   static_cast<double>(smooth.size() - 1));
        const std::size_t below = static_cast<std::size_t>(at);
        const std::size_t above = std::min(below + 1, smooth.size() - 1);
        const double t = at - static_cast<double>(below);
        result[row] = (1.0 - t) * smooth[below] + t * smooth[above];
    }
    return result;
}

/// Takes the mean off the columns and divides each group by its deviation.
void scale(std::array<std::vector<double>, kColumns>& columns) {
    for (const Group& group : kGroups) {
        double sum = 0.0;
        for (std::size_t c = group.first; c < group.first + group.count; ++c) {
            const double mean = mean_of(columns[c]);
            for (double& value : columns[c]) {
                value -= mean;
                sum += value * value;
            }
        }
        const double count = static_cast<double>(group.count * columns[group.first].size());
        const double factor = group.weight / std::max(std::sqrt(sum / count), group.unmoved);
        for (std::size_t c = group.first; c < group.first + group.count; ++c) {
            for (double& value : columns[c]) {
                value *= factor;
            }
        }
    }
}

/// The largest speed in the columns of the hands and feet, m/s.
double movement_of(const std::array<std::vector<double>, kColumns>& columns) {
    double most = 0.0;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        most = std::max({most, columns[0][i], columns[1][i]});
        for (std::size_t c = 6; i > 0 && c < kColumns; c += 3) {
            double square = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double step = columns[c + axis][i] - columns[c + axis][i - 1];
                square += step * step;
            }
            most = std::max(most, std::sqrt(square) * kSignalRate);
        }
    }
    return most;
}

}  // namespace

MotionSignals motion_signals(const TrainingClip& clip) {
    std::vector<Pose> poses = clip.poses;
    std::vector<std::array<SourceFoot, 2>> feet = clip.feet;
    bridge_faults(poses, clip.faults);
    bridge_faults(feet, clip.faults);
    const double rate = clip.frames_per_second;
    const std::size_t rows =
        static_cast<std::size_t>(static_cast<double>(poses.size() - 1) / rate * kSignalRate) + 1;
    std::array<std::vector<double>, kColumns> columns = columns_of(poses, feet, rate);
    const std::vector<double> taps = low_pass_taps(kLowPass, rate);
    for (std::vector<double>& column : columns) {
        column = reduced(column, rate, taps, rows);
    }
    MotionSignals signals;
    signals.movement = movement_of(columns);
    scale(columns);
    signals.track.columns = kColumns;
    for (std::size_t row = 0; row < rows; ++row) {
        for (const std::vector<double>& column : columns) {
            signals.track.values.push_back(column[row]);
        }
    }
    FootRules rules;
    rules.step_speed = kSmallStep;
    for (const Side side : kSides) {
        for (const double frame : landings(feet, side, rate, rules)) {
            signals.landings.push_back({frame / rate * kSignalRate, side});
        }
    }
    std::sort(signals.landings.begin(),
              signals.landings.end(),
              [](const SignalLanding& a, const SignalLanding& b) { return a.row < b.row; });
    return signals;
}

Expected<void> check_motion(const TrainingClip& clip, const MotionSignals& signals) {
    if (signals.movement < kStillSpeed) {
        return fail("nothing moves in it");
    }
    if (const double seconds = signals.seconds(); seconds < kShortestMotion) {
        return fail(fmt::format("lasts {:.2f} s, shorter than two beats", seconds));
    }
    for (std::size_t i = 0; i < clip.poses.size(); ++i) {
        if (!is_finite(clip.poses[i])) {
            return fail(fmt::format("the pose of frame {} is not finite", i));
        }
    }
    return {};
}

void row_between(const FeatureTrack& track, double at, std::span<double> to) noexcept {
    const double last = static_cast<double>(track.rows() - 1);
    const double clamped = std::clamp(at, 0.0, last);
    const std::size_t below = static_cast<std::size_t>(clamped);
    const std::size_t above = std::min(below + 1, track.rows() - 1);
    const double t = clamped - static_cast<double>(below);
    const std::span<const double> a = track.row(below);
    const std::span<const double> b = track.row(above);
    for (std::size_t c = 0; c < to.size(); ++c) {
        to[c] = (1.0 - t) * a[c] + t * b[c];
    }
}

}  // namespace raks::motion
