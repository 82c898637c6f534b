#include "motion/evaluate/landing_error.hpp"

#include <algorithm>
#include <cmath>

#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

constexpr double kEarliest = -0.4;  // beats from the count, as learn_feet has it
constexpr double kNearEnd = 1.0;    // seconds
constexpr double kNear = 0.080;     // seconds

// Seconds to the next count; the last one lasts as long as the one before.
double beat_at(std::span<const double> count_times, std::size_t k) {
    const std::size_t first = k + 1 < count_times.size() ? k : k - 1;
    return count_times[first + 1] - count_times[first];
}

void summarize(LandingReport& report) {
    if (report.landings.empty()) {
        return;
    }
    const auto n = static_cast<double>(report.landings.size());
    double squares = 0.0;
    for (const Landing& landing : report.landings) {
        report.mean += landing.error / n;
        report.within_80_ms += std::abs(landing.error) <= kNear ? 1.0 / n : 0.0;
    }
    for (const Landing& landing : report.landings) {
        const double deviation = landing.error - report.mean;
        squares += deviation * deviation / n;
    }
    report.deviation = std::sqrt(squares);
}

/// Times of the landings in [from, to), seconds.
std::vector<double> landings_between(std::span<const double> moments,
                                     double frames_per_second,
                                     double from,
                                     double to) {
    std::vector<double> times;
    for (const double moment : moments) {
        const double time = moment / frames_per_second;
        if (time >= from && time < to) {
            times.push_back(time);
        }
    }
    return times;
}

}  // namespace

LandingReport landing_errors(const BodyTrack& track,
                             const FigureModel& figure,
                             std::span<const double> count_times,
                             int least_repeats) {
    LandingReport report;
    if (count_times.size() < 2 || track.frames() < 2) {
        return report;
    }
    const double end = static_cast<double>(track.frames() - 1) / track.frames_per_second;
    const auto beats = static_cast<std::size_t>(figure.beats);
    for (const Side side : kSides) {
        const auto& offsets = figure.landings[static_cast<std::size_t>(side)];
        const std::vector<double> moments = landings(track.feet, side, track.frames_per_second);
        for (std::size_t k = 0; k < count_times.size(); ++k) {
            const double beat = beat_at(count_times, k);
            const double from = count_times[k] + kEarliest * beat;
            if (from < kNearEnd || count_times[k] > end - kNearEnd) {
                continue;
            }
            const std::size_t count = k % beats;
            const bool is_expected = offsets[count].repeats >= least_repeats;
            const std::vector<double> found =
                landings_between(moments, track.frames_per_second, from, from + beat);
            if (!is_expected) {
                report.unexpected += found.size();
            } else if (found.empty()) {
                ++report.missing;
            } else {
                report.unexpected += found.size() - 1;
                const double error =
                    found[0] - count_times[k] - offsets[count].median.count() * beat;
                report.landings.push_back({side, static_cast<int>(count) + 1, found[0], error});
            }
        }
    }
    summarize(report);
    return report;
}

}  // namespace raks::motion
