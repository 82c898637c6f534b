#include "motion/dance/trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace raks::motion {
namespace {

// The figure is solved three times in a row and the middle one kept: its ends then know their
// neighbours, as those of a dance that goes on.
constexpr std::size_t kTurns = 3;
// The states' variance holds what differs between takes (a hold, a stance), not only between
// moments of one dance: taken as it is, the values weigh too little against the deltas, the motion
// turns out too soft (a quarter of the humans' jerk) and a state is felt three beats away.
constexpr double kStaticTrust = 6.0;
constexpr double kMostLost = 0.6;  // of the variance: x 1.6 in amplitude

/// Symmetric positive definite matrix with two bands beside the diagonal, and a right side.
struct BandedSystem {
    explicit BandedSystem(std::size_t size) : bands(size), right(size) {}
    std::vector<std::array<double, 3>> bands;  // [i][k]: element (i, i - k)
    std::vector<double> right;

    /// Adds w (c^T x - mean)^2, where c has three coefficients at first, first + 1, first + 2
    /// (those outside the system are left out: the window at the very ends).
    void add(std::ptrdiff_t first, const std::array<double, 3>& c, double weight, double mean) {
        const auto size = static_cast<std::ptrdiff_t>(right.size());
        for (std::ptrdiff_t a = 0; a < 3; ++a) {
            const std::ptrdiff_t i = first + a;
            if (i < 0 || i >= size || c[static_cast<std::size_t>(a)] == 0.0) {
                continue;
            }
            right[static_cast<std::size_t>(i)] += weight * mean * c[static_cast<std::size_t>(a)];
            for (std::ptrdiff_t b = 0; b <= a; ++b) {
                const std::ptrdiff_t j = first + b;
                if (j >= 0) {
                    bands[static_cast<std::size_t>(i)][static_cast<std::size_t>(a - b)] +=
                        weight * c[static_cast<std::size_t>(a)] * c[static_cast<std::size_t>(b)];
                }
            }
        }
    }

    static constexpr double kLeastDiagonal = 1e-12;  // of a sound system it is far larger

    /// Cholesky in the bands, then two substitutions. The result is in `right`.
    void solve() {
        const std::size_t size = right.size();
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t k = std::min<std::size_t>(2, i); k > 0; --k) {
                double sum = bands[i][k];
                if (k == 1 && i >= 2) {
                    sum -= bands[i][2] * bands[i - 1][1];
                }
                bands[i][k] = sum / bands[i - k][0];
            }
            double diagonal = bands[i][0];
            for (std::size_t k = 1; k <= std::min<std::size_t>(2, i); ++k) {
                diagonal -= bands[i][k] * bands[i][k];
            }
            bands[i][0] = std::sqrt(std::max(diagonal, kLeastDiagonal));
        }
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t k = 1; k <= std::min<std::size_t>(2, i); ++k) {
                right[i] -= bands[i][k] * right[i - k];
            }
            right[i] /= bands[i][0];
        }
        for (std::size_t i = size; i-- > 0;) {
            for (std::size_t k = 1; k <= 2 && i + k < size; ++k) {
                right[i] -= bands[i + k][k] * right[i + k];
            }
            right[i] /= bands[i][0];
        }
    }
};

}  // namespace

FeatureTrack most_likely_trajectory(const PartModel& part, std::size_t samples) {
    FeatureTrack track;
    track.columns = part.dimension();
    track.values.resize(track.columns * samples);
    if (samples == 0) {
        return track;
    }
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        BandedSystem system(kTurns * samples);
        for (std::size_t i = 0; i < kTurns * samples; ++i) {
            const FigureState& state = part.states[part.state_at(i % samples, samples)];
            const auto before = static_cast<std::ptrdiff_t>(i) - 1;
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
        system.solve();
        for (std::size_t i = 0; i < samples; ++i) {
            track.values[i * track.columns + feature] = system.right[samples + i];
        }
    }
    return track;
}

void restore_variance(const PartModel& part, double amount, FeatureTrack& track) {
    const auto is_about_mean = [&](std::size_t feature) {
        if (part.features == FigureFeatures::positions) {
            return feature >= part.root_features();
        }
        // Height and tilts: the only angles whose mean is not zero by definition.
        return part.part == Part::torso &&
               feature >= static_cast<std::size_t>(RootFeature::height) && feature < kRootFeatures;
    };
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        double own = 0.0;
        for (const FigureState& state : part.states) {
            own += state.variance[feature] / static_cast<double>(part.states.size());
        }
        const double share = std::min(kMostLost, own / part.global_variance[feature]);
        const double factor = 1.0 + amount * (std::sqrt(1.0 / (1.0 - share)) - 1.0);
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
