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

void summarize(LandingReport& report) {
    report.mean = report.deviation = report.within_80_ms = 0.0;
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

LandingReport landing_errors(const BodyTrack& track,
                             const FigureModel& figure,
                             std::span<const double> count_times,
                             int least_repeats) {
    if (count_times.size() < 2) {
        return {};
    }
    std::vector<HeardCount> counts;
    for (std::size_t k = 0; k < count_times.size(); ++k) {
        const std::size_t count = k % static_cast<std::size_t>(figure.beats);
        counts.push_back({&figure, count, count_times[k], beat_at(count_times, k)});
    }
    return landing_errors(track, counts, least_repeats);
}

LandingReport landing_errors(const BodyTrack& track,
                             std::span<const HeardCount> counts,
                             int least_repeats) {
    LandingReport report;
    if (track.frames() < 2) {
        return report;
    }
    const double end = static_cast<double>(track.frames() - 1) / track.frames_per_second;
    for (const Side side : kSides) {
        const std::vector<double> moments = landings(track.feet, side, track.frames_per_second);
        for (const HeardCount& heard : counts) {
            const double from = heard.time + kEarliest * heard.beat;
            if (from < kNearEnd || heard.time > end - kNearEnd) {
                continue;
            }
            const LandingOffset& offset =
                heard.figure->landings[static_cast<std::size_t>(side)][heard.count];
            const std::vector<double> found =
                landings_between(moments, track.frames_per_second, from, from + heard.beat);
            if (offset.repeats < least_repeats) {
                report.unexpected += found.size();
            } else if (found.empty()) {
                ++report.missing;
            } else {
                report.unexpected += found.size() - 1;
                const double error = found[0] - heard.time - offset.median.count() * heard.beat;
                report.landings.push_back(
                    {side, static_cast<int>(heard.count) + 1, found[0], error, heard.figure});
            }
        }
    }
    summarize(report);
    return report;
}

}  // namespace raks::motion
