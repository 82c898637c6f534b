#include "training/discovery/repeat_segmentation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "training/discovery/motion_signals.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kLengths = 13;     // of a repeat that are tried
constexpr double kReach = 0.15;          // of them about the period, relative
constexpr double kLeastVariance = 0.05;  // so that few repeats are not trusted too far
// Neighbouring phases tell nearly the same, so that each counts a quarter.
constexpr double kShare = 0.25;
constexpr double kEntry = 8.0;          // nats: price of a repeat that does not follow another one
constexpr double kChange = 1.0;         // nats: for each step between the lengths of neighbours
constexpr std::size_t kGap = kLengths;  // state: no repeat
constexpr std::size_t kStates = kLengths + 1;

using StateScores = std::array<double, kStates>;

struct ColumnMoments {
    std::vector<double> mean;
    std::vector<double> variance;
};

ColumnMoments moments_of(const FeatureTrack& track) {
    ColumnMoments moments{std::vector<double>(track.columns, 0.0),
                          std::vector<double>(track.columns, 0.0)};
    const double n = static_cast<double>(track.rows());
    for (std::size_t i = 0; i < track.rows(); ++i) {
        const std::span<const double> row = track.row(i);
        for (std::size_t c = 0; c < track.columns; ++c) {
            moments.mean[c] += row[c] / n;
            moments.variance[c] += row[c] * row[c] / n;
        }
    }
    for (std::size_t c = 0; c < track.columns; ++c) {
        moments.variance[c] += kLeastVariance - moments.mean[c] * moments.mean[c];
    }
    return moments;
}

double row_at_phase(const RepeatSpan& repeat, std::size_t phase) {
    return repeat.start +
           repeat.length * (static_cast<double>(phase) + 0.5) / static_cast<double>(kRepeatPhases);
}

/// Log-likelihood of repeats over that of no repeat, for every start and length.
class RepeatScores {
 public:
    RepeatScores(const FeatureTrack& track, const RepeatTemplate& repeat)
        : track_(track), repeat_(repeat), whole_(moments_of(track)), row_(track.columns) {
        for (std::size_t c = 0; c < track.columns; ++c) {
            offset_ += 0.5 * std::log(whole_.variance[c] / repeat.variance[c]);
        }
    }

    double operator()(const RepeatSpan& span) {
        double sum = 0.0;
        for (std::size_t phase = 0; phase < kRepeatPhases; ++phase) {
            row_between(track_, row_at_phase(span, phase), row_);
            for (std::size_t c = 0; c < track_.columns; ++c) {
                const double own = row_[c] - repeat_.mean[phase * track_.columns + c];
                const double other = row_[c] - whole_.mean[c];
                sum += 0.5 * (other * other / whole_.variance[c] - own * own / repeat_.variance[c]);
            }
        }
        return kShare * (sum + offset_ * static_cast<double>(kRepeatPhases));
    }

 private:
    const FeatureTrack& track_;
    const RepeatTemplate& repeat_;
    ColumnMoments whole_;
    std::vector<double> row_;
    double offset_ = 0.0;
};

/// The best score of what may precede a repeat of length `k`, and that state.
std::pair<double, std::uint8_t> best_before(const StateScores& before, std::size_t k) {
    std::pair<double, std::uint8_t> best{before[kGap] - kEntry, kGap};
    for (std::size_t j = 0; j < kLengths; ++j) {
        const double steps = std::abs(static_cast<double>(j) - static_cast<double>(k));
        const double score = before[j] - kChange * steps;
        if (score > best.first) {
            best = {score, static_cast<std::uint8_t>(j)};
        }
    }
    return best;
}

std::array<std::size_t, kLengths> lengths_about(double period) {
    std::array<std::size_t, kLengths> lengths{};
    for (std::size_t k = 0; k < kLengths; ++k) {
        const double at = static_cast<double>(k) / (kLengths - 1);
        const double length = period * (1.0 - kReach + 2.0 * kReach * at);
        lengths[k] = std::max<std::size_t>(4, static_cast<std::size_t>(std::lround(length)));
    }
    return lengths;
}

}  // namespace

RepeatTemplate folded_template(const FeatureTrack& track, double period) {
    std::vector<RepeatSpan> cycles;
    const double rows = static_cast<double>(track.rows());
    for (double start = 0.0; start + period <= rows; start += period) {
        cycles.push_back({start, period});
    }
    if (cycles.empty()) {
        cycles.push_back({0.0, rows});
    }
    return template_of(track, cycles);
}

RepeatTemplate template_of(const FeatureTrack& track, std::span<const RepeatSpan> repeats) {
    const std::size_t columns = track.columns;
    RepeatTemplate result{std::vector<double>(kRepeatPhases * columns, 0.0),
                          std::vector<double>(columns, 0.0)};
    const double n = static_cast<double>(repeats.size());
    std::vector<double> row(columns);
    // Twice over the repeats: means first, then the squares about them.
    for (const RepeatSpan& repeat : repeats) {
        for (std::size_t phase = 0; phase < kRepeatPhases; ++phase) {
            row_between(track, row_at_phase(repeat, phase), row);
            for (std::size_t c = 0; c < columns; ++c) {
                result.mean[phase * columns + c] += row[c] / n;
            }
        }
    }
    for (const RepeatSpan& repeat : repeats) {
        for (std::size_t phase = 0; phase < kRepeatPhases; ++phase) {
            row_between(track, row_at_phase(repeat, phase), row);
            for (std::size_t c = 0; c < columns; ++c) {
                const double d = row[c] - result.mean[phase * columns + c];
                result.variance[c] += d * d / (n * static_cast<double>(kRepeatPhases));
            }
        }
    }
    for (double& variance : result.variance) {
        variance += kLeastVariance;
    }
    return result;
}

std::vector<RepeatSpan> segment_repeats(const FeatureTrack& track,
                                        const RepeatTemplate& repeat,
                                        double period) {
    constexpr double kNever = std::numeric_limits<double>::lowest() / 4.0;
    const std::array<std::size_t, kLengths> lengths = lengths_about(period);
    const std::size_t rows = track.rows();
    StateScores impossible;
    impossible.fill(kNever);
    std::vector<StateScores> best(rows + 1, impossible);
    std::vector<std::array<std::uint8_t, kStates>> from(rows + 1);
    best[0][kGap] = 0.0;
    RepeatScores score(track, repeat);
    for (std::size_t t = 1; t <= rows; ++t) {
        const auto before = std::max_element(best[t - 1].begin(), best[t - 1].end());
        best[t][kGap] = *before;
        from[t][kGap] = static_cast<std::uint8_t>(before - best[t - 1].begin());
        for (std::size_t k = 0; k < kLengths; ++k) {
            if (lengths[k] > t) {
                continue;
            }
            const std::size_t start = t - lengths[k];
            const auto [earlier, state] = best_before(best[start], k);
            from[t][k] = state;
            best[t][k] =
                earlier + score({static_cast<double>(start), static_cast<double>(lengths[k])});
        }
    }
    std::vector<RepeatSpan> repeats;
    std::size_t t = rows;
    auto state = static_cast<std::size_t>(std::max_element(best[t].begin(), best[t].end()) -
                                          best[t].begin());
    while (t > 0) {
        const std::size_t earlier = from[t][state];
        if (state == kGap) {
            --t;
        } else {
            t -= lengths[state];
            repeats.push_back({static_cast<double>(t), static_cast<double>(lengths[state])});
        }
        state = earlier;
    }
    std::reverse(repeats.begin(), repeats.end());
    return repeats;
}

}  // namespace raks::motion
