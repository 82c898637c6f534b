#include "motion/dance/baking/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/dance/baking/banded_system.hpp"

namespace raks::motion {
namespace {

// The figure is solved three times in a row and the middle one kept, so that its ends are joined
// like those of a dance that goes on.
constexpr std::size_t kTurns = 3;
// Weight of the static term. The states' variance also holds what differs between takes (a hold, a
// stance), not only between moments of one dance. At weight 1 the means count too little against
// the deltas: the motion turns out too soft (a quarter of people's jerk) and a state influences
// values three beats away.
constexpr double kStaticTrust = 6.0;
constexpr double kMostLost = 0.6;  // of the variance: 1 / sqrt(1 - 0.6) = 1.6 in amplitude

}  // namespace

FeatureTrack most_likely_trajectory(const PartModel& part, std::size_t samples) {
    FeatureTrack track;
    track.columns = part.dimension();
    track.values.resize(track.columns * samples);
    if (samples == 0) {
        return track;
    }
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        BandedSystem<2> system(kTurns * samples);
        for (std::size_t i = 0; i < kTurns * samples; ++i) {
            const FigureState& state = part.states[part.state_at(i % samples, samples)];
            const auto before = static_cast<std::ptrdiff_t>(i) - 1;
            // Static, delta and delta-delta terms, each weighted by its inverse variance
            // (FigureState's windows).
            system.add(before,
                       {0.0, 1.0, 0.0},
                       kStaticTrust / state.variance[feature],
                       state.mean[feature]);
            if (i == 0 || i + 1 == kTurns * samples) {
                continue;  // no neighbours: value alone
            }
            system.add(before,
                       {-0.5, 0.0, 0.5},
                       1.0 / state.delta_variance[feature],
                       state.delta_mean[feature]);
            system.add(before,
                       {1.0, -2.0, 1.0},
                       1.0 / state.delta_delta_variance[feature],
                       state.delta_delta_mean[feature]);
        }
        const std::vector<double> solved = system.solve();
        for (std::size_t i = 0; i < samples; ++i) {
            track.values[i * track.columns + feature] = solved[samples + i];
        }
    }
    return track;
}

void restore_variance(const PartModel& part, double amount, FeatureTrack& track) {
    const auto is_about_mean = [&](std::size_t feature) {
        if (part.features == FigureFeatures::positions) {
            return feature >= part.root_features();
        }
        // Of the angles only height and tilts have a mean that is not zero by definition.
        return part.part == Part::torso &&
               feature >= static_cast<std::size_t>(RootFeature::height) && feature < kRootFeatures;
    };
    // The hips' velocities left and forward.
    const auto is_of_travel = [&](std::size_t feature) {
        return feature < part.root_features() &&
               feature <= static_cast<std::size_t>(RootFeature::velocity_forward);
    };
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        double own = 0.0;
        for (const FigureState& state : part.states) {
            own += state.variance[feature] / static_cast<double>(part.states.size());
        }
        const double share = std::min(kMostLost, own / part.global_variance[feature]);
        const double done = is_of_travel(feature) ? 1.0 : amount;
        const double factor = 1.0 + done * (std::sqrt(1.0 / (1.0 - share)) - 1.0);
        double centre = 0.0;
        for (std::size_t i = 0; i < track.rows() && is_about_mean(feature); ++i) {
            centre += track.row(i)[feature] / static_cast<double>(track.rows());
        }
        for (std::size_t i = 0; i < track.rows(); ++i) {
            double& value = track.row(i)[feature];
            value = centre + factor * (value - centre);
        }
    }
}

FeatureTrack upsampled(const FeatureTrack& track, std::size_t factor) {
    FeatureTrack fine;
    fine.columns = track.columns;
    const std::size_t rows = track.rows();
    for (std::size_t i = 0; i < rows * factor; ++i) {
        const std::size_t at = i / factor;
        const double t = static_cast<double>(i % factor) / static_cast<double>(factor);
        const auto p0 = track.row((at + rows - 1) % rows);
        const auto p1 = track.row(at);
        const auto p2 = track.row((at + 1) % rows);
        const auto p3 = track.row((at + 2) % rows);
        for (std::size_t f = 0; f < track.columns; ++f) {
            const double a = -0.5 * p0[f] + 1.5 * p1[f] - 1.5 * p2[f] + 0.5 * p3[f];
            const double b = p0[f] - 2.5 * p1[f] + 2.0 * p2[f] - 0.5 * p3[f];
            const double c = 0.5 * (p2[f] - p0[f]);
            fine.values.push_back(((a * t + b) * t + c) * t + p1[f]);
        }
    }
    return fine;
}

}  // namespace raks::motion
