#include "motion/dance/baking/variation.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "motion/dance/baking/feature_draw.hpp"
#include "motion/dance/body/closed_curve.hpp"

namespace raks::motion {
namespace {

// Shares of the variance by harmonic of the figure, the constant first. With these the distance
// between two repeats is that of people's and the jerk rises by a few per cent only.
constexpr std::array<double, 5> kHarmonics = {0.25, 0.3, 0.2, 0.15, 0.1};
// Scales of the states' deviation, by kind of feature. Their variance also holds what moves within
// a slice and what differs between people's takes (stance, hold).
constexpr double kTorso = 0.95;
constexpr double kUpper = 1.3;
constexpr double kFarthest = 1.8;       // deviations, soft limit of the curve
constexpr double kFarthestTurn = 1.0;   // radians of a joint, soft limit
constexpr double kFarthestPlace = 0.2;  // metres of a joint, soft limit
constexpr double kVelocity = 0.2;     // of the hips; with more the legs would not reach their steps
constexpr double kHeight = 0.15;      // it differs between takes, not between repeats
constexpr double kArmPlaces = 2.0;    // restoring bone lengths removes half of it
constexpr double kTrunkPlaces = 1.2;  // with more, the shoulders lean off the hips by 15 cm
// Includes the hips', from which the legs must reach the floor
constexpr double kLowerPlaces = 0.6;

bool is_trunk(Bone bone) {
    return bone == Bone::spine || bone == Bone::chest || bone == Bone::neck || bone == Bone::head;
}

// The scale of one feature's variation.
double amount_of(const PartModel& part, std::size_t feature) {
    if (part.features == FigureFeatures::positions) {
        if (feature < part.root_features()) {
            return kVelocity;
        }
        if (part.part == Part::upper) {
            return is_trunk(part.joints[(feature - part.root_features()) / 3].bone) ? kTrunkPlaces
                                                                                    : kArmPlaces;
        }
        return kLowerPlaces;
    }
    if (part.part != Part::torso) {
        return kUpper;
    }
    if (feature <= static_cast<std::size_t>(RootFeature::yaw_rate)) {
        return kVelocity;
    }
    return feature == static_cast<std::size_t>(RootFeature::height) ? kHeight : kTorso;
}

/// Deviation of one feature over the phase, smoothed over a slice so that it does not step between
/// states.
std::vector<double> deviation_of(const PartModel& part, std::size_t feature, std::size_t samples) {
    std::vector<double> deviation(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        deviation[i] = std::sqrt(part.states[part.state_at(i, samples)].variance[feature]);
    }
    const double slice = static_cast<double>(samples) / static_cast<double>(part.states.size());
    return smoothed(deviation, slice);
}

/// Limits each joint's distance from its learnt rotation or place, softly (tanh): with a larger one
/// the shorter way between two varied arms could change sides (arm_mixes.hpp).
void hold_joints(const PartModel& part, const FeatureTrack& learnt, FeatureTrack& track) {
    const std::size_t first = part.root_features();
    const double farthest =
        part.features == FigureFeatures::positions ? kFarthestPlace : kFarthestTurn;
    for (std::size_t i = 0; i < track.rows(); ++i) {
        for (std::size_t at = first; at + 2 < track.columns; at += 3) {
            const std::span<double> values = track.row(i).subspan(at, 3);
            const std::span<const double> from = learnt.row(i).subspan(at, 3);
            const double apart =
                std::hypot(values[0] - from[0], values[1] - from[1], values[2] - from[2]);
            const double share =
                farthest * std::tanh(apart / farthest) / std::max(apart, farthest * 1e-6);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                values[axis] = from[axis] + share * (values[axis] - from[axis]);
            }
        }
    }
}

}  // namespace

void vary(const PartModel& part, const CounterRandom& random, FeatureTrack& track) {
    const FeatureTrack learnt = track;
    const std::size_t samples = track.rows();
    const std::size_t size = part.dimension();
    // Two coefficients (cosine, sine) a harmonic and feature, correlated over the features.
    std::array<std::array<Eigen::VectorXd, 2>, kHarmonics.size()> coefficients;
    FeatureDraw draw(part);
    for (auto& pair : coefficients) {
        for (Eigen::VectorXd& one : pair) {
            one = draw.next(random);
        }
    }
    for (std::size_t feature = 0; feature < size; ++feature) {
        const std::vector<double> deviation = deviation_of(part, feature, samples);
        const double amount = amount_of(part, feature);
        for (std::size_t i = 0; i < samples; ++i) {
            double curve = 0.0;
            for (std::size_t h = 0; h < kHarmonics.size(); ++h) {
                const double angle =
                    2.0 * M_PI * static_cast<double>(h * i) / static_cast<double>(samples);
                const auto at = static_cast<Eigen::Index>(feature);
                curve += std::sqrt(kHarmonics[h]) * (coefficients[h][0][at] * std::cos(angle) +
                                                     coefficients[h][1][at] * std::sin(angle));
            }
            // No repeat is far out: people's are not, and joints would turn over.
            track.row(i)[feature] +=
                amount * deviation[i] * kFarthest * std::tanh(curve / kFarthest);
        }
    }
    hold_joints(part, learnt, track);
}

}  // namespace raks::motion
