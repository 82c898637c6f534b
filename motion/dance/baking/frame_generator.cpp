#include "motion/dance/baking/frame_generator.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "motion/dance/body/closed_curve.hpp"

namespace raks::motion {
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
