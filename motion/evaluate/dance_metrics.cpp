#include "motion/evaluate/dance_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kContactSpeed = 0.25;   // m/s
constexpr double kContactHeight = 0.05;  // metres
constexpr std::size_t kContactFrames = 4;

using Places = std::vector<glm::dvec3>;

// Binomial filter 1-4-6-4-1, ends repeated.
Places smoothed(const Places& places) {
    constexpr std::array<double, 5> kTaps = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
    const auto last = static_cast<std::ptrdiff_t>(places.size()) - 1;
    Places result(places.size(), glm::dvec3(0.0));
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        for (std::ptrdiff_t k = 0; k < 5; ++k) {
            const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(i + k - 2, 0, last);
            result[static_cast<std::size_t>(i)] +=
                kTaps[static_cast<std::size_t>(k)] * places[static_cast<std::size_t>(at)];
        }
    }
    return result;
}

// Central differences, one-sided at the ends; m/s.
std::vector<double> speeds(const Places& places, double frames_per_second) {
    std::vector<double> result(places.size(), 0.0);
    for (std::size_t i = 0; places.size() > 1 && i < places.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0;
        const std::size_t after = std::min(i + 1, places.size() - 1);
        result[i] = glm::length(places[after] - places[before]) * frames_per_second /
                    static_cast<double>(after - before);
    }
    return result;
}

double mean(const std::vector<double>& values) {
    return values.empty() ? 0.0
                          : std::accumulate(values.begin(), values.end(), 0.0) /
                                static_cast<double>(values.size());
}

// Largest distance over the floor from where the toe came down.
double slip(const Places& toe, std::size_t begin, std::size_t end) {
    double furthest = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3 way = toe[i] - toe[begin];
        furthest = std::max(furthest, std::hypot(way.x, way.z));
    }
    return furthest;
}

void add_slips(const Places& toe, const std::vector<bool>& touches, std::vector<double>& slips) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= touches.size(); ++i) {
        if (i < touches.size() && touches[i]) {
            continue;
        }
        if (i - begin >= kContactFrames) {
            slips.push_back(slip(toe, begin, i));
        }
        begin = i + 1;
    }
}

}  // namespace

double percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - std::floor(at)) * (values[above] - values[below]);
}

JerkReport jerk_of(const BodyTrack& track) {
    if (track.frames() < 4) {
        return {};
    }
    const double cube = std::pow(track.frames_per_second, 3.0);
    std::vector<double> jerks;
    jerks.reserve(track.frames() * kBodyBones.size());
    double squares = 0.0;
    for (std::size_t j = 0; j < kBodyBones.size(); ++j) {
        Places places(track.frames());
        for (std::size_t f = 0; f < track.frames(); ++f) {
            places[f] = track.joints[f][j];
        }
        places = smoothed(places);
        for (std::size_t f = 0; f + 3 < places.size(); ++f) {
            const glm::dvec3 third =
                places[f + 3] - 3.0 * places[f + 2] + 3.0 * places[f + 1] - places[f];
            jerks.push_back(cube * glm::length(third));
            squares += jerks.back() * jerks.back();
        }
    }
    JerkReport report;
    report.rms = std::sqrt(squares / static_cast<double>(jerks.size()));
    report.highest = *std::max_element(jerks.begin(), jerks.end());
    report.p999 = percentile(std::move(jerks), 0.999);
    return report;
}

ContactReport contacts_of(const BodyTrack& track, std::optional<double> floor_height) {
    ContactReport report;
    if (track.frames() < 2) {
        return report;
    }
    std::vector<double> toe_speeds;
    double lowest = 1e300;
    for (const Side side : kSides) {
        Places toe(track.frames());
        for (std::size_t f = 0; f < track.frames(); ++f) {
            toe[f] = track.feet[f][static_cast<std::size_t>(side)].toe_tip;
        }
        toe = smoothed(toe);
        std::vector<double> heights(toe.size());
        std::transform(toe.begin(), toe.end(), heights.begin(), [](const glm::dvec3& place) {
            return place.y;
        });
        const double floor = floor_height.value_or(percentile(heights, 0.05));
        const std::vector<double> speed = speeds(toe, track.frames_per_second);
        std::vector<bool> touches(toe.size());
        for (std::size_t f = 0; f < toe.size(); ++f) {
            touches[f] = speed[f] < kContactSpeed && heights[f] - floor < kContactHeight;
            lowest = std::min(lowest, heights[f] - floor);
            if (touches[f]) {
                toe_speeds.push_back(speed[f]);
            }
        }
        add_slips(toe, touches, report.slips);
    }
    report.share = static_cast<double>(toe_speeds.size()) / static_cast<double>(2 * track.frames());
    report.slip_median = percentile(report.slips, 0.5);
    report.slip_p90 = percentile(report.slips, 0.9);
    report.slip_p95 = percentile(report.slips, 0.95);
    report.toe_speed_mean = mean(toe_speeds);
    report.toe_speed_p95 = percentile(toe_speeds, 0.95);
    report.lowest_toe = lowest;
    return report;
}

}  // namespace raks::motion
