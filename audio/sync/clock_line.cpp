#include "audio/sync/clock_line.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

double distance(const ClockLine& line, const ClockPoint& point) {
    return std::abs(point.other - line.at(point.time));
}

// Least squares through the chosen points, about their mean, so that long times lose no digits.
std::optional<ClockLine> least_squares(std::span<const ClockPoint> points,
                                       const std::vector<bool>& chosen) {
    double count = 0.0;
    double mean_time = 0.0;
    double mean_shift = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (chosen[i]) {
            count += 1.0;
            mean_time += points[i].time;
            mean_shift += points[i].other - points[i].time;
        }
    }
    if (count < 2.0) {
        return std::nullopt;
    }
    mean_time /= count;
    mean_shift /= count;
    double both = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (chosen[i]) {
            const double time = points[i].time - mean_time;
            both += time * (points[i].other - points[i].time - mean_shift);
            squares += time * time;
        }
    }
    if (!(squares > 0.0)) {
        return std::nullopt;
    }
    const double slope = both / squares;
    return ClockLine{mean_shift - slope * mean_time, slope * 1e6};
}

// Marks the points within `tolerance`; returns how many.
std::size_t mark(std::span<const ClockPoint> points,
                 const ClockLine& line,
                 double tolerance,
                 std::vector<bool>& is_on_line) {
    std::size_t used = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        is_on_line[i] = distance(line, points[i]) <= tolerance;
        used += is_on_line[i] ? 1U : 0U;
    }
    return used;
}

// The line through that pair of points which has the most other points near it. Of lines with
// equally many, the one with the smallest sum of distances.
std::optional<ClockLine> best_pair(std::span<const ClockPoint> points, double tolerance) {
    std::optional<ClockLine> best;
    std::size_t most = 0;
    double least_sum = 0.0;
    for (std::size_t a = 0; a < points.size(); ++a) {
        for (std::size_t b = a + 1; b < points.size(); ++b) {
            const double span = points[b].time - points[a].time;
            if (span == 0.0) {
                continue;
            }
            const double shift = points[a].other - points[a].time;
            const double slope = (points[b].other - points[b].time - shift) / span;
            const ClockLine line{shift - slope * points[a].time, slope * 1e6};
            std::size_t near = 0;
            double sum = 0.0;
            for (const ClockPoint& point : points) {
                const double off = distance(line, point);
                near += off <= tolerance ? 1U : 0U;
                sum += std::min(off, tolerance);
            }
            if (near > most || (near == most && sum < least_sum)) {
                best = line;
                most = near;
                least_sum = sum;
            }
        }
    }
    return best;
}

}  // namespace

std::optional<ClockFit> fit_clock_line(std::span<const ClockPoint> points, double tolerance) {
    auto line = best_pair(points, tolerance);
    if (!line) {
        return std::nullopt;
    }
    ClockFit fit;
    fit.is_on_line.resize(points.size());
    // A line through two points is a little off the line that fits all points near it. After each
    // fit, which points are near changes a little, so fitting is repeated.
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
        mark(points, *line, tolerance, fit.is_on_line);
        const auto fitted = least_squares(points, fit.is_on_line);
        if (!fitted) {
            return std::nullopt;
        }
        line = fitted;
    }
    fit.line = *line;
    fit.used = mark(points, fit.line, tolerance, fit.is_on_line);
    double squares = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (fit.is_on_line[i]) {
            squares += std::pow(distance(fit.line, points[i]), 2);
        }
    }
    fit.spread = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(fit.used, 1)));
    return fit;
}

}  // namespace raks::audio
