#include "motion/dance/baking/trajectory.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "motion/dance/baking/banded_system.hpp"
#include "motion/dance/body/curves.hpp"

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

namespace {

// Widths of both filters, 9 and 3 frames of 60 a second. A wider Gaussian (8 frames) reduces the
// jerk to a tenth of people's, and the feet slide no less.
constexpr double kMedianSeconds = 9.0 / 60.0;
constexpr double kSigmaSeconds = 3.0 / 60.0;
constexpr std::uint64_t kFrameStream = 1000;  // first random stream, apart from those of passages

/// Chance of the part to go on to the next state, at a count whose row of the occurrence table is
/// `shares`.
double chance_to_go_on(const PartModel& part,
                       std::size_t state,
                       const std::vector<double>& shares) {
    if (state + 1 >= part.states.size()) {
        return 0.0;
    }
    const double stay = part.transition[state][state] * shares[state];
    const double go = part.transition[state][state + 1] * shares[state + 1];
    if (stay + go > 0.0) {
        return go / (stay + go);
    }
    const auto after = shares.begin() + static_cast<std::ptrdiff_t>(state) + 1;
    return std::accumulate(after, shares.end(), 0.0) > 0.0 ? 1.0 : 0.0;
}

Eigen::MatrixXd matrix_of(const std::vector<std::vector<double>>& rows) {
    const auto size = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd matrix(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
        for (Eigen::Index j = 0; j < size; ++j) {
            matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        }
    }
    return matrix;
}

/// Factors that turn white noise into a state's deviations: Cholesky factors of the covariances,
/// one a state, or a single one where the covariance is tied.
std::vector<Eigen::MatrixXd> deviations_of(const PartModel& part) {
    std::vector<Eigen::MatrixXd> roots;
    for (const auto& rows : part.state_covariances) {
        if (part.covariance_kind == CovarianceKind::full) {
            roots.emplace_back(matrix_of(rows).llt().matrixL());
            continue;
        }
        const Eigen::Map<const Eigen::VectorXd> variances(
            rows.front().data(), static_cast<Eigen::Index>(rows.front().size()));
        roots.emplace_back(variances.cwiseSqrt().asDiagonal());
    }
    if (roots.empty()) {
        roots.emplace_back(matrix_of(part.covariance).llt().matrixL());
    }
    return roots;
}

/// One independent Gaussian draw from its state for each sample of the path.
FeatureTrack draws_of(const PartModel& part,
                      const std::vector<std::size_t>& path,
                      const CounterRandom& random) {
    const std::vector<Eigen::MatrixXd> roots = deviations_of(part);
    FeatureTrack track;
    track.columns = part.dimension();
    std::uint64_t number = 0;
    for (const std::size_t state : path) {
        Eigen::VectorXd white(static_cast<Eigen::Index>(track.columns));
        for (double& value : white) {
            value = random.normal(number++);
        }
        const Eigen::VectorXd apart = roots[roots.size() == 1 ? 0 : state] * white;
        for (std::size_t feature = 0; feature < track.columns; ++feature) {
            track.values.push_back(part.states[state].mean[feature] +
                                   apart[static_cast<Eigen::Index>(feature)]);
        }
    }
    return track;
}

/// Running median of `window` (odd) values of a closed curve.
std::vector<double> medians(const std::vector<double>& values, std::size_t window) {
    const auto reach = static_cast<std::ptrdiff_t>(window / 2);
    std::vector<double> result(values.size());
    std::vector<double> around(window);
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t k = 0; k < window; ++k) {
            const std::ptrdiff_t at =
                static_cast<std::ptrdiff_t>(i) + static_cast<std::ptrdiff_t>(k) - reach;
            around[k] = values[wrap(at, values.size())];
        }
        std::nth_element(around.begin(), around.begin() + reach, around.end());
        result[i] = around[window / 2];
    }
    return result;
}

// Median, then Gaussian, of each feature: the median takes outliers off before they are spread.
void smooth(double samples_per_second, FeatureTrack& track) {
    const std::size_t window =
        2 * static_cast<std::size_t>(std::lround(0.5 * kMedianSeconds * samples_per_second)) + 1;
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        std::vector<double> values(track.rows());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = track.row(i)[feature];
        }
        values = smoothed(medians(values, window), kSigmaSeconds * samples_per_second);
        for (std::size_t i = 0; i < values.size(); ++i) {
            track.row(i)[feature] = values[i];
        }
    }
}

}  // namespace

CoupledPath coupled_path(const FigureModel& model, const CounterRandom& random) {
    const std::size_t a_beat = static_cast<std::size_t>(model.samples_per_beat);
    CoupledPath paths;
    for (const PartModel& part : model.parts) {
        std::vector<std::size_t>& path = paths[static_cast<std::size_t>(part.part)];
        path.push_back(0);
        for (std::size_t t = 1; t < model.samples(); ++t) {
            const std::size_t state = path.back();
            const double chance = chance_to_go_on(part, state, part.occurrence[t / a_beat]);
            path.push_back(random.uniform(t) < chance ? state + 1 : state);
        }
    }
    return paths;
}

FigureTracks drawn_tracks(const FigureModel& model, std::uint64_t figure, std::uint64_t repeat) {
    const std::uint64_t stream = kFrameStream + repeat * (kParts.size() + 1);
    const CoupledPath paths = coupled_path(model, CounterRandom(figure, stream));
    FigureTracks tracks;
    for (const PartModel& part : model.parts) {
        const auto p = static_cast<std::size_t>(part.part);
        tracks[p] = draws_of(part, paths[p], CounterRandom(figure, stream + 1 + p));
        smooth(model.samples_per_beat * model.learnt_tempo.beats_per_second(), tracks[p]);
    }
    return tracks;
}

}  // namespace raks::motion
