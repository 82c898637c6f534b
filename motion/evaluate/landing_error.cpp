#include "motion/evaluate/landing_error.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "motion/figures/foot_events.hpp"

namespace raks::motion {
namespace {

// Beats from a count to the start of its window, as in learn_feet()
constexpr double kEarliest = -0.4;
constexpr double kFarthest = 0.5;  // beats between a landing and the learnt one
constexpr double kNearEnd = 1.0;   // seconds from the track's ends without counts
constexpr double kNear = 0.080;    // seconds; limit of within_80_ms

// Seconds to the next count; the last one lasts as long as the one before.
double beat_at(std::span<const double> count_times, std::size_t k) {
    const std::size_t first = k + 1 < count_times.size() ? k : k - 1;
    return count_times[first + 1] - count_times[first];
}

/// A learnt landing at one count of this dance.
struct DueLanding {
    const AudibleCount* audible = nullptr;
    double time = 0.0;             // seconds at which it is due
    std::optional<double> landed;  // seconds of the nearest landing matched with it
    bool is_judged = true;         // near enough to a beat
};

/// Matches each landing with the due one nearest to it (in beats); of several, a due one keeps the
/// nearest.
void give_landings(std::span<const double> times, std::vector<DueLanding>& due) {
    for (const double time : times) {
        const auto away = [&](const DueLanding& one) {
            return std::abs(time - one.time) / one.audible->beat;
        };
        const auto nearest =
            std::min_element(due.begin(), due.end(), [&](const auto& a, const auto& b) {
                return away(a) < away(b);
            });
        if (nearest == due.end() || away(*nearest) > kFarthest) {
            continue;
        }
        const bool is_nearer = !nearest->landed || std::abs(time - nearest->time) <
                                                       std::abs(*nearest->landed - nearest->time);
        nearest->landed = is_nearer ? time : *nearest->landed;
    }
}

/// Number of landings within the windows of the counts.
std::size_t landings_within(std::span<const double> times, std::span<const AudibleCount> counts) {
    return static_cast<std::size_t>(std::count_if(times.begin(), times.end(), [&](double time) {
        return std::any_of(counts.begin(), counts.end(), [&](const AudibleCount& audible) {
            const double from = audible.time + kEarliest * audible.beat;
            return time >= from && time < from + audible.beat;
        });
    }));
}

/// Counts at least kNearEnd from the track's ends.
std::vector<AudibleCount> judged_counts(const BodyTrack& track,
                                        std::span<const AudibleCount> counts) {
    const double end = static_cast<double>(track.frames() - 1) / track.frames_per_second;
    std::vector<AudibleCount> judged;
    std::copy_if(
        counts.begin(), counts.end(), std::back_inserter(judged), [&](const auto& audible) {
            return audible.time + kEarliest * audible.beat >= kNearEnd &&
                   audible.time <= end - kNearEnd;
        });
    return judged;
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
                             const JudgedLandings& judged) {
    if (count_times.size() < 2) {
        return {};
    }
    std::vector<AudibleCount> counts;
    for (std::size_t k = 0; k < count_times.size(); ++k) {
        // Counts start over with each repeat.
        const std::size_t count = k % static_cast<std::size_t>(figure.beats);
        counts.push_back({&figure, count, count_times[k], beat_at(count_times, k)});
    }
    return landing_errors(track, counts, judged);
}

LandingReport landing_errors(const BodyTrack& track,
                             std::span<const AudibleCount> counts,
                             const JudgedLandings& judged) {
    LandingReport report;
    if (track.frames() < 2) {
        return report;
    }
    const std::vector<AudibleCount> heard = judged_counts(track, counts);
    for (const Side side : kSides) {
        std::vector<double> times = landings(track.feet, side, track.frames_per_second);
        // From frames to seconds.
        for (double& time : times) {
            time /= track.frames_per_second;
        }
        std::vector<DueLanding> due;
        for (const AudibleCount& audible : heard) {
            const auto learnt_by = static_cast<std::size_t>(side) ^ (audible.is_mirrored ? 1U : 0U);
            const LandingOffset& offset = audible.figure->landings[learnt_by][audible.count];
            // Only landings that people share have a moment to be compared with.
            if (offset.is_one(judged.least_repeats, audible.figure->repeats)) {
                const double beats = offset.median.count();
                due.push_back({&audible,
                               audible.time + beats * audible.beat,
                               std::nullopt,
                               std::abs(beats) <= judged.farthest});
            }
        }
        give_landings(times, due);
        std::size_t expected = 0;
        for (const DueLanding& one : due) {
            if (!one.landed) {
                report.missing += one.is_judged ? 1U : 0U;
                continue;
            }
            ++expected;
            if (!one.is_judged) {
                ++report.off_beat;
                continue;
            }
            report.landings.push_back({side,
                                       static_cast<int>(one.audible->count) + 1,
                                       *one.landed,
                                       *one.landed - one.time,
                                       one.audible->figure});
        }
        // What was not matched is unexpected.
        const std::size_t all = landings_within(times, heard);
        report.unexpected += all - std::min(all, expected);
    }
    summarize(report);
    return report;
}

}  // namespace raks::motion
