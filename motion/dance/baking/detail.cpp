#include "motion/dance/baking/detail.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motion/dance/baking/feature_draw.hpp"
#include "motion/dance/body/closed_curve.hpp"

namespace raks::motion {
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
