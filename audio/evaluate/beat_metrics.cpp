#include "audio/evaluate/beat_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/statistics.hpp"

namespace raks::audio {
namespace {

constexpr double kRounding = 1e-9;       // seconds: 70 ms apart is a hit however it was rounded
constexpr double kCemgilSigma = 0.040;   // seconds
constexpr double kPScoreRate = 100.0;    // grid points a second
constexpr double kPScoreWindow = 0.2;    // of the median interval
constexpr double kContinuity = 0.175;    // of the interval, in phase and in period
constexpr std::size_t kBins = 41;        // of the beat error histogram
constexpr std::size_t kLockBeats = 4;    // in a row
constexpr double kTempoAccuracy = 0.04;  // of the tempo

// Differences (estimate - reference) of the pairs within `tolerance`, one to one. Walking both
// sorted lists at once and pairing greedily gives the greatest possible number of pairs, as every
// beat has the same tolerance.
std::vector<double> hit_errors(BeatTimes reference, BeatTimes estimate, double tolerance) {
    std::vector<double> errors;
    std::size_t r = 0;
    std::size_t e = 0;
    while (r < reference.size() && e < estimate.size()) {
        const double difference = estimate[e] - reference[r];
        if (std::abs(difference) <= tolerance + kRounding) {
            errors.push_back(difference);
            ++r;
            ++e;
        } else if (difference > 0.0) {
            // The reference beat has no partner: every later estimate is even further away.
            ++r;
        } else {
            ++e;
        }
    }
    return errors;
}

// Index of the beat nearest to `time`; of several at the same distance the first. `times` is not
// empty.
std::size_t nearest(BeatTimes times, double time) {
    const auto after = std::lower_bound(times.begin(), times.end(), time);
    if (after == times.begin()) {
        return 0;
    }
    const bool is_later_nearer = after != times.end() && *after - time < time - *(after - 1);
    const auto found =
        // Beats that coincide: the first index of their time, as the reference implementation takes
        // it.
        is_later_nearer ? after : std::lower_bound(times.begin(), after, *(after - 1));
    return static_cast<std::size_t>(found - times.begin());
}

// Seconds between neighbours; one fewer than times.
std::vector<double> intervals(BeatTimes times) {
    std::vector<double> result;
    for (std::size_t i = 1; i < times.size(); ++i) {
        result.push_back(times[i] - times[i - 1]);
    }
    return result;
}

// Points of a grid of 100 Hz that starts at `origin`, ascending, each once: the pulse train of the
// P-score as a list of the places where it is 1.
std::vector<double> grid_points(BeatTimes times, double origin) {
    std::vector<double> points;
    for (const double time : times) {
        const double point = std::ceil((time - origin) * kPScoreRate);
        if (points.empty() || point != points.back()) {
            points.push_back(point);
        }
    }
    return points;
}

enum class Side { before, after };

// Interval from beat `at` to its neighbour on that side. The last beat has only the one before it.
double interval_at(BeatTimes times, std::size_t at, Side side) {
    const bool looks_ahead = side == Side::after && at + 1 < times.size();
    return looks_ahead ? times[at + 1] - times[at] : times[at] - times[at - 1];
}

// Continuity at one metrical level.
struct RightBeats {
    double longest = 0.0;  // share of beats in the longest run
    double total = 0.0;    // share of beats
};

// Scores one metrical level; both lists have at least 2 beats.
RightBeats right_beats(BeatTimes reference, BeatTimes estimate) {
    std::vector<bool> is_used(reference.size(), false);
    std::size_t run = 0;
    std::size_t longest = 0;
    std::size_t total = 0;
    for (std::size_t e = 0; e < estimate.size(); ++e) {
        const std::size_t r = nearest(reference, estimate[e]);
        // The first beat has no interval before it, so the interval after it is compared.
        const Side side = e == 0 || r == 0 ? Side::after : Side::before;
        const double reference_interval = interval_at(reference, r, side);
        const double interval = interval_at(estimate, e, side);
        const double phase = std::abs(estimate[e] - reference[r]) / reference_interval;
        const double period = std::abs(1.0 - interval / reference_interval);
        // A reference beat counts once: of two estimates on it, as at double tempo, the second is
        // wrong.
        const bool is_right =
            !is_used[r] && reference_interval > 0.0 && phase < kContinuity && period < kContinuity;
        if (is_right) {
            is_used[r] = true;
            ++total;
        }
        run = is_right ? run + 1 : 0;
        longest = std::max(longest, run);
    }
    // Over the greater count, so that neither missing nor surplus beats pass unpunished.
    const auto count = static_cast<double>(std::max(reference.size(), estimate.size()));
    return {static_cast<double>(longest) / count, static_cast<double>(total) / count};
}

// Beats at double tempo: each beat and the off-beat in the middle of the interval after it.
std::vector<double> doubled(BeatTimes times) {
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        result.push_back(times[i]);
        result.push_back((times[i + 1] - times[i]) * 0.5 + times[i]);
    }
    result.push_back(times.back());
    return result;
}

// Beats at half tempo, beginning with beat `first` (0 or 1).
std::vector<double> every_second(BeatTimes times, std::size_t first) {
    std::vector<double> result;
    for (std::size_t i = first; i < times.size(); i += 2) {
        result.push_back(times[i]);
    }
    return result;
}

// Error of `time` as a share of the local interval of `beats`, wrapped into (-0.5, 0.5].
double phase_error(BeatTimes beats, double time) {
    const std::size_t last = beats.size() - 1;
    const std::size_t k = nearest(beats, time);
    const double error = time - beats[k];
    const bool looks_back = k == last || error < 0.0;
    // Before the first beat the reference implementation's index wraps to the last: see the header.
    const std::size_t before = k == 0 ? last : k - 1;
    const double interval = looks_back ? beats[k] - beats[before] : beats[k + 1] - beats[k];
    const double share = error / interval + 0.5;
    return share - std::ceil(share) + 0.5;
}

// Entropy, in bits, of the histogram of the errors of `estimate` against `beats`. It is greatest
// where the errors are spread evenly, which means that the estimate knows nothing of the beats.
double error_entropy(BeatTimes beats, BeatTimes estimate) {
    std::array<std::size_t, kBins> histogram{};
    std::array<double, kBins> edges{};  // lower ones
    for (std::size_t i = 0; i < kBins; ++i) {
        edges[i] = static_cast<double>(i) * (1.0 / static_cast<double>(kBins)) - 0.5;
    }
    for (const double time : estimate) {
        const double error = phase_error(beats, time);
        // Two beats at the same time have an interval of 0: an error has no share of it and no bin.
        if (std::isfinite(error)) {
            const auto above = std::upper_bound(edges.begin(), edges.end(), error);
            ++histogram[static_cast<std::size_t>(
                std::max<std::ptrdiff_t>(above - edges.begin() - 1, 0))];
        }
    }
    double entropy = 0.0;
    for (const std::size_t count : histogram) {
        if (count > 0) {
            const double share = static_cast<double>(count) / static_cast<double>(estimate.size());
            entropy -= share * std::log2(share);
        }
    }
    return entropy;
}

}  // namespace

double f_measure(BeatTimes reference, BeatTimes estimate, double tolerance) {
    if (reference.empty() || estimate.empty()) {
        return 0.0;
    }
    const auto hits = static_cast<double>(hit_errors(reference, estimate, tolerance).size());
    return 2.0 * hits / static_cast<double>(reference.size() + estimate.size());
}

double cemgil_accuracy(BeatTimes reference, BeatTimes estimate) {
    if (reference.empty() || estimate.empty()) {
        return 0.0;
    }
    double sum = 0.0;
    for (const double beat : reference) {
        const double distance = estimate[nearest(estimate, beat)] - beat;
        sum += std::exp(-distance * distance / (2.0 * kCemgilSigma * kCemgilSigma));
    }
    return sum / (0.5 * static_cast<double>(reference.size() + estimate.size()));
}

double p_score(BeatTimes reference, BeatTimes estimate) {
    if (reference.size() < 2 || estimate.size() < 2) {
        return 0.0;
    }
    const double origin = std::min(reference.front(), estimate.front());
    const std::vector<double> reference_points = grid_points(reference, origin);
    const std::vector<double> points = grid_points(estimate, origin);
    // All in points of 10 ms from here on.
    const auto interval = median(intervals(reference_points));
    if (!interval) {
        return 0.0;
    }
    // Hits within the window are the sum of the cross-correlation over the allowed lags.
    const double window = std::nearbyint(kPScoreWindow * *interval);
    std::size_t hits = 0;
    for (const double point : reference_points) {
        const auto first = std::lower_bound(points.begin(), points.end(), point - window);
        const auto behind = std::upper_bound(first, points.end(), point + window);
        hits += static_cast<std::size_t>(behind - first);
    }
    const std::size_t count = std::max(reference.size(), estimate.size());
    return static_cast<double>(hits) / static_cast<double>(count);
}

Continuity continuity(BeatTimes reference, BeatTimes estimate) {
    if (reference.size() < 2 || estimate.size() < 2) {
        return {};
    }
    const RightBeats annotated = right_beats(reference, estimate);
    Continuity result{annotated.longest, annotated.total, annotated.longest, annotated.total};
    // Off-beat, double tempo, and half tempo on odd or on even beats (Davies 2009, 3.1.5).
    const std::vector<double> twice = doubled(reference);
    for (const auto& level :
         {every_second(twice, 1), twice, every_second(reference, 0), every_second(reference, 1)}) {
        if (level.size() > 1) {
            const RightBeats right = right_beats(level, estimate);
            result.aml_longest = std::max(result.aml_longest, right.longest);
            result.aml_total = std::max(result.aml_total, right.total);
        }
    }
    return result;
}

double information_gain(BeatTimes reference, BeatTimes estimate) {
    if (reference.size() < 2 || estimate.size() < 2) {
        return 0.0;
    }
    // Both directions: an estimate at half the tempo is exact against the reference, but not the
    // other way round.
    const double entropy =
        std::max(error_entropy(reference, estimate), error_entropy(estimate, reference));
    return 1.0 - entropy / std::log2(static_cast<double>(kBins));
}

std::optional<double> time_to_lock(BeatTimes reference, BeatTimes estimate) {
    for (std::size_t i = 0; i + kLockBeats <= reference.size(); ++i) {
        // Row i is locked when the estimates between its first and last beat are exactly these
        // four.
        const BeatTimes row = reference.subspan(i, kLockBeats);
        const auto first =
            std::lower_bound(estimate.begin(), estimate.end(), row.front() - kHitTolerance);
        const auto behind = std::upper_bound(first, estimate.end(), row.back() + kHitTolerance);
        const bool is_locked = static_cast<std::size_t>(behind - first) == kLockBeats &&
                               std::equal(first, behind, row.begin(), [](double e, double r) {
                                   return std::abs(e - r) <= kHitTolerance;
                               });
        if (is_locked) {
            return row.front() - reference.front();
        }
    }
    return std::nullopt;
}

TempoAccuracy tempo_accuracy(BeatTimes reference, BeatTimes estimate) {
    if (reference.size() < 3 || estimate.size() < 3) {
        return {};
    }
    // Median intervals as tempi: one missed beat does not change them.
    const double right = 1.0 / *median(intervals(reference));
    const double tempo = 1.0 / *median(intervals(estimate));
    const auto is_near = [&](double factor) {
        return std::abs(tempo - right * factor) <= kTempoAccuracy * right * factor;
    };
    const bool is_exact = is_near(1.0);
    return {is_exact,
            is_exact || is_near(2.0) || is_near(3.0) || is_near(0.5) || is_near(1.0 / 3.0)};
}

std::optional<double> median_bias(BeatTimes reference, BeatTimes estimate) {
    return median(hit_errors(reference, estimate, kHitTolerance));
}

std::optional<double> median_error(BeatTimes reference, BeatTimes estimate) {
    std::vector<double> errors = hit_errors(reference, estimate, kHitTolerance);
    for (double& error : errors) {
        error = std::abs(error);
    }
    return median(errors);
}

}  // namespace raks::audio
