#include "training/discovery/repeat_period.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "training/discovery/motion_signals.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kBins = 32;
constexpr double kStep = 0.005;       // between tried periods, relative
constexpr double kLeastCycles = 2.5;  // of the longest period within the motion
constexpr double kOctaves = 1.0;      // deviation of the preference

double preference(double seconds, double likely) {
    const double octaves = std::log2(seconds / likely) / kOctaves;
    return std::exp(-0.5 * octaves * octaves);
}

}  // namespace

double explained_by_period(const FeatureTrack& track, double rows) {
    const std::size_t columns = track.columns;
    std::vector<double> sums(kBins * columns, 0.0);
    std::vector<double> counts(kBins, 0.0);
    std::vector<double> total(columns, 0.0);
    double square = 0.0;
    for (std::size_t i = 0; i < track.rows(); ++i) {
        const double phase = std::fmod(static_cast<double>(i) / rows, 1.0);
        const std::size_t bin = std::min(static_cast<std::size_t>(phase * kBins), kBins - 1);
        counts[bin] += 1.0;
        const std::span<const double> row = track.row(i);
        for (std::size_t c = 0; c < columns; ++c) {
            sums[bin * columns + c] += row[c];
            total[c] += row[c];
            square += row[c] * row[c];
        }
    }
    // Sums of squares about the mean: of all rows, and of the bins' means.
    const double n = static_cast<double>(track.rows());
    double within = 0.0;
    for (const double sum : total) {
        within -= sum * sum / n;
    }
    double between = within;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        for (std::size_t c = 0; counts[bin] > 0.0 && c < columns; ++c) {
            between += sums[bin * columns + c] * sums[bin * columns + c] / counts[bin];
        }
    }
    const double all = square + within;
    const double chance = rows / n;
    return all > 0.0 && chance < 1.0 ? (between / all - chance) / (1.0 - chance) : 0.0;
}

std::optional<RepeatPeriod> best_period(const FeatureTrack& track, const PeriodSearch& search) {
    const double longest =
        std::min(search.longest * kSignalRate, static_cast<double>(track.rows()) / kLeastCycles);
    std::optional<RepeatPeriod> best;
    double best_score = 0.0;
    for (double rows = search.shortest * kSignalRate; rows <= longest; rows *= 1.0 + kStep) {
        const double seconds = rows / kSignalRate;
        if (search.is_allowed && !search.is_allowed(seconds)) {
            continue;
        }
        const double explained = explained_by_period(track, rows);
        const double score = explained * preference(seconds, search.likely);
        if (!best || score > best_score) {
            best = RepeatPeriod{rows, explained};
            best_score = score;
        }
    }
    return best;
}

}  // namespace raks::motion
