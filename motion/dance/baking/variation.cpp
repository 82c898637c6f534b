#include "motion/dance/baking/variation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "motion/dance/body/curves.hpp"

namespace raks::motion {
namespace {

/// Draws normal vectors whose features are correlated as in the part's covariance, each of variance
/// one. Threads: one. Real-time: no (it allocates).
class FeatureDraw {
 public:
    /// `part`: covariance positive definite, as validate() checks.
    explicit FeatureDraw(const PartModel& part);
    /// The next vector (D features); consecutive calls use consecutive numbers of `random`.
    [[nodiscard]] Eigen::VectorXd next(const CounterRandom& random);

 private:
    Eigen::MatrixXd root_;    // lower triangle of the correlation
    std::uint64_t draw_ = 0;  // number of the next draw
};

// The Cholesky factor of the correlation matrix turns white noise into correlated features.
FeatureDraw::FeatureDraw(const PartModel& part) {
    const auto size = static_cast<Eigen::Index>(part.dimension());
    Eigen::MatrixXd correlation(size, size);
    const auto covariance = [&](Eigen::Index i, Eigen::Index j) {
        return part.covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j) {
            correlation(i, j) = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
        }
    }
    root_ = correlation.llt().matrixL();
}

Eigen::VectorXd FeatureDraw::next(const CounterRandom& random) {
    Eigen::VectorXd white(root_.rows());
    for (double& value : white) {
        value = random.normal(draw_++);
    }
    return root_ * white;
}

// Shares of the variance by harmonic of the figure, the constant first. With these the distance
// between two repeats is that of people's and the jerk rises by a few per cent only.
constexpr std::array<double, 5> kHarmonics = {0.25, 0.3, 0.2, 0.15, 0.1};
// The same for arms and spine of people, whose repeats differ by the hold and the carriage, hence
// slowly: as quick as above, arms moved by a third faster than people's.
constexpr std::array<double, 5> kSlowHarmonics = {0.4, 0.4, 0.15, 0.05, 0.0};
// Scales of the states' deviation, by kind of feature. Their variance also holds what moves within
// a slice and what differs between people's takes (stance, hold).
constexpr double kTorso = 0.95;
constexpr double kSpine = 1.2;  // of people's: averaging takes away half of a spine's bends
constexpr double kUpper = 1.3;
constexpr double kPeoplesUpper = 0.9;
constexpr double kFarthestCurve = 1.8;  // deviations, soft limit of the curve
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

// Whether a feature is a rotation of the arms or the spine of people.
bool is_carriage(const PartModel& part, bool is_captured, std::size_t feature) {
    return is_captured && part.features == FigureFeatures::angles &&
           (part.part == Part::upper ||
            (part.part == Part::torso && feature >= part.root_features()));
}

// The scale of one feature's variation.
double amount_of(const PartModel& part, bool is_captured, std::size_t feature) {
    if (is_carriage(part, is_captured, feature)) {
        return part.part == Part::upper ? kPeoplesUpper : kSpine;
    }
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
/// the shorter way between two varied arms could change sides (figure_passage.hpp).
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

void vary(const PartModel& part,
          bool is_captured,
          const CounterRandom& random,
          FeatureTrack& track) {
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
        const double amount = amount_of(part, is_captured, feature);
        const auto& harmonics =
            is_carriage(part, is_captured, feature) ? kSlowHarmonics : kHarmonics;
        for (std::size_t i = 0; i < samples; ++i) {
            double curve = 0.0;
            for (std::size_t h = 0; h < kHarmonics.size(); ++h) {
                const double angle =
                    2.0 * M_PI * static_cast<double>(h * i) / static_cast<double>(samples);
                const auto at = static_cast<Eigen::Index>(feature);
                curve += std::sqrt(harmonics[h]) * (coefficients[h][0][at] * std::cos(angle) +
                                                    coefficients[h][1][at] * std::sin(angle));
            }
            // No repeat is far out: people's are not, and joints would turn over.
            track.row(i)[feature] +=
                amount * deviation[i] * kFarthestCurve * std::tanh(curve / kFarthestCurve);
        }
    }
    hold_joints(part, learnt, track);
}

namespace {
// Band in cycles a beat (3 to 6 Hz in salsa). Faster ones would be as strong, but a display shows
// little of them and a filter removes them; slower ones belong to the variation.
constexpr double kLowest = 1.1;
constexpr double kHighest = 2.1;
// Limits of detail_lost(), of people's accelerations of the hips, rms.
constexpr double kAllLost = 0.6;
constexpr double kAllKept = 0.8;
constexpr double kMostMoved = 1.0;  // of the deviation between repeats, rms

double square(double x) { return x * x; }

/// Second differences of one feature of a closed curve, per sample squared.
std::vector<double> accelerations(const FeatureTrack& track, std::size_t feature) {
    const std::size_t rows = track.rows();
    std::vector<double> result(rows);
    for (std::size_t i = 0; i < rows; ++i) {
        result[i] = track.row((i + rows - 1) % rows)[feature] - 2.0 * track.row(i)[feature] +
                    track.row((i + 1) % rows)[feature];
    }
    return result;
}

/// Mean square of people's accelerations at a sample: variance plus squared mean of the state's
/// delta-delta.
double people_at(const PartModel& part, std::size_t feature, std::size_t i, std::size_t rows) {
    const FigureState& state = part.states[part.state_at(i, rows)];
    return state.delta_delta_variance[feature] + square(state.delta_delta_mean[feature]);
}

/// The track's own accelerations as a share of people's, rms.
double share_kept(const PartModel& part, const FeatureTrack& track, std::size_t feature) {
    double kept = 0.0;
    double people = 0.0;
    const std::vector<double> own = accelerations(track, feature);
    for (std::size_t i = 0; i < own.size(); ++i) {
        kept += square(own[i]);
        people += people_at(part, feature, i, own.size());
    }
    return std::sqrt(kept / people);
}

}  // namespace

double detail_lost(const FigureModel& model, const FigureTracks& learnt) {
    std::array<double, kRootFeatures> kept{};
    for (std::size_t feature = 0; feature < kept.size(); ++feature) {
        kept[feature] = share_kept(model.root_part(), root_of(model, learnt), feature);
    }
    // The median over the root's features: one feature alone may be still or noisy.
    std::sort(kept.begin(), kept.end());
    const double middle = kept[kept.size() / 2];
    return std::clamp((kAllKept - middle) / (kAllKept - kAllLost), 0.0, 1.0);
}

void add_detail(const PartModel& part,
                const CounterRandom& random,
                double amount,
                FeatureTrack& track) {
    const std::size_t rows = track.rows();
    const auto beats = static_cast<double>(part.occurrence.size());
    const auto first = static_cast<int>(std::ceil(kLowest * beats));
    const auto last = static_cast<int>(std::floor(kHighest * beats));
    const double harmonics = last - first + 1;
    // Random cosine and sine amplitudes for each harmonic of the figure in the band.
    FeatureDraw draw(part);
    std::vector<std::array<Eigen::VectorXd, 2>> coefficients;
    for (int h = first; h <= last; ++h) {
        coefficients.push_back({draw.next(random), draw.next(random)});
    }
    const double slice = static_cast<double>(rows) / static_cast<double>(part.states.size());
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        const std::vector<double> own = accelerations(track, feature);
        std::vector<double> missing(rows);
        for (std::size_t i = 0; i < rows; ++i) {
            // The missing mean square; smoothed over a slice, so that it does not step between
            // states.
            missing[i] = people_at(part, feature, i, rows) - square(own[i]);
        }
        missing = smoothed(missing, slice);
        std::vector<double> added(rows);
        double moved = 0.0;
        double apart = 0.0;
        for (std::size_t i = 0; i < rows; ++i) {
            double curve = 0.0;
            for (int h = first; h <= last; ++h) {
                const double turn = 2.0 * M_PI * h / static_cast<double>(rows);
                const auto& [cosine, sine] = coefficients[static_cast<std::size_t>(h - first)];
                const auto at = static_cast<Eigen::Index>(feature);
                const double angle = turn * static_cast<double>(i);
                // The divisor is the gain of a second difference at this frequency: `curve` has
                // unit acceleration in each harmonic.
                curve += (cosine[at] * std::cos(angle) + sine[at] * std::sin(angle)) /
                         square(2.0 * std::sin(0.5 * turn));
            }
            added[i] = amount * std::sqrt(std::max(missing[i], 0.0) / harmonics) * curve;
            moved += square(added[i]);
            apart += part.states[part.state_at(i, rows)].variance[feature];
        }
        // Scaled down where it would move farther than repeats differ.
        const double share = std::min(1.0, kMostMoved * std::sqrt(apart / moved));
        for (std::size_t i = 0; i < rows && moved > 0.0; ++i) {
            track.row(i)[feature] += share * added[i];
        }
    }
}

}  // namespace raks::motion
