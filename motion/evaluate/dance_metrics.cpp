#include "motion/evaluate/dance_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/statistics.hpp"
#include "motion/evaluate/body_track.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kContactSpeed = 0.25;     // m/s
constexpr double kContactHeight = 0.05;    // metres
constexpr std::size_t kContactFrames = 4;  // shortest contact that counts as a slip

double mean(const std::vector<double>& values) {
    return values.empty() ? 0.0
                          : std::accumulate(values.begin(), values.end(), 0.0) /
                                static_cast<double>(values.size());
}

// Whether the third difference at frame f, which uses frames f to f + 3 and the filter two more to
// each side, lies within counted frames; otherwise the body would seem to stop dead where a stretch
// ends. A track without such marks is measured to its ends, as the reference program does.
bool has_sound_neighbours(const MetricFrames& frames, std::size_t f, std::size_t count) {
    if (frames.counted.empty()) {
        return true;
    }
    if (f < 2 || f + 5 >= count) {
        return false;
    }
    for (std::size_t i = f - 2; i <= f + 5; ++i) {
        if (!frames.is_counted(i)) {
            return false;
        }
    }
    return true;
}

// Slip of one contact: largest distance over the floor from where the toe came down.
double slip(const Places& toe, std::size_t begin, std::size_t end) {
    double furthest = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3 way = toe[i] - toe[begin];
        furthest = std::max(furthest, std::hypot(way.x, way.z));
    }
    return furthest;
}

// One slip for each run of touching frames that is long enough.
void add_slips(const Places& toe, const std::vector<bool>& touches, ContactReport& report) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= touches.size(); ++i) {
        if (i < touches.size() && touches[i]) {
            continue;
        }
        if (i - begin >= kContactFrames) {
            report.slips.push_back(slip(toe, begin, i));
            report.standing += begin == 0 ? 1U : 0U;
        }
        begin = i + 1;
    }
}

}  // namespace

JerkReport jerk_of(const BodyTrack& track, const MetricFrames& frames) {
    if (track.frames() < 4) {
        return {};
    }
    const double cube = std::pow(track.frames_per_second, 3.0);
    std::vector<double> jerks;
    jerks.reserve(track.frames() * kBodyBones.size());
    for (std::size_t j = 0; j < kBodyBones.size(); ++j) {
        const Places places = smoothed(joint_places(track, j));
        for (std::size_t f = 0; f + 3 < places.size(); ++f) {
            if (!has_sound_neighbours(frames, f, places.size())) {
                continue;
            }
            const glm::dvec3 third =
                places[f + 3] - 3.0 * places[f + 2] + 3.0 * places[f + 1] - places[f];
            // The pace in the middle of the four frames.
            jerks.push_back(cube * glm::length(third) / std::pow(frames.pace_at(f + 1), 3.0));
        }
    }
    return jerk_of_samples(std::move(jerks));
}

JerkReport jerk_of_samples(std::vector<double> samples) {
    JerkReport report;
    if (samples.empty()) {
        return report;
    }
    double squares = 0.0;
    for (const double jerk : samples) {
        squares += jerk * jerk;
    }
    report.rms = std::sqrt(squares / static_cast<double>(samples.size()));
    report.highest = *std::max_element(samples.begin(), samples.end());
    report.p999 = percentile(samples, 0.999);
    report.samples = std::move(samples);
    return report;
}

ContactReport contacts_of(const BodyTrack& track,
                          std::optional<double> floor_height,
                          const MetricFrames& frames) {
    ContactReport report;
    if (track.frames() < 2) {
        return report;
    }
    std::vector<double> toe_speeds;
    std::size_t measured = 0;
    double lowest = 1e300;
    for (const Side side : kSides) {
        const Places toe = smoothed(toe_places(track, side));
        std::vector<double> heights(toe.size());
        std::transform(toe.begin(), toe.end(), heights.begin(), [](const glm::dvec3& place) {
            return place.y;
        });
        // Low, but no outlier: the floor of a capture is not known exactly.
        const double floor = floor_height.value_or(percentile(heights, 0.05));
        const std::vector<double> speed = speeds(toe, track.frames_per_second);
        std::vector<bool> touches(toe.size());
        for (std::size_t f = 0; f < toe.size(); ++f) {
            if (!frames.is_counted(f)) {
                continue;
            }
            ++measured;
            touches[f] = speed[f] < kContactSpeed && heights[f] - floor < kContactHeight;
            lowest = std::min(lowest, heights[f] - floor);
            // The pace scales what is reported, not what decides.
            if (touches[f]) {
                toe_speeds.push_back(speed[f] / frames.pace_at(f));
            }
        }
        add_slips(toe, touches, report);
    }
    if (measured == 0) {
        return report;
    }
    report.share = static_cast<double>(toe_speeds.size()) / static_cast<double>(measured);
    report.lowest_toe = lowest;
    report.toe_speeds = std::move(toe_speeds);
    summarize(report);
    return report;
}

void summarize(ContactReport& report) {
    report.slip_median = percentile(report.slips, 0.5);
    report.slip_p90 = percentile(report.slips, 0.9);
    report.slip_p95 = percentile(report.slips, 0.95);
    report.toe_speed_mean = mean(report.toe_speeds);
    report.toe_speed_p95 = percentile(report.toe_speeds, 0.95);
}

namespace {

/// Catmull-Rom interpolation of one point at a fractional frame; the ends are repeated.
template <typename PlaceAt>
glm::dvec3 between(const PlaceAt& place_at, std::size_t frames, double at) {
    const auto last = static_cast<std::ptrdiff_t>(frames) - 1;
    const auto i = static_cast<std::ptrdiff_t>(at);
    const double t = at - static_cast<double>(i);
    const auto place = [&](std::ptrdiff_t k) {
        return place_at(static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + k, 0, last)));
    };
    const glm::dvec3 p0 = place(-1);
    const glm::dvec3 p1 = place(0);
    const glm::dvec3 p2 = place(1);
    const glm::dvec3 p3 = place(2);
    const glm::dvec3 a = -0.5 * p0 + 1.5 * p1 - 1.5 * p2 + 0.5 * p3;
    const glm::dvec3 b = p0 - 2.5 * p1 + 2.0 * p2 - 0.5 * p3;
    return ((a * t + b) * t + 0.5 * (p2 - p0)) * t + p1;
}

// Frames of the result, none beyond the last original one.
std::size_t frames_played(std::size_t frames, double pace) {
    return frames == 0 ? 0 : static_cast<std::size_t>(static_cast<double>(frames - 1) / pace) + 1;
}

}  // namespace

BodyTrack played_at_pace(const BodyTrack& track, double pace) {
    BodyTrack played;
    played.frames_per_second = track.frames_per_second;
    played.joints.resize(frames_played(track.frames(), pace));
    played.feet.resize(played.joints.size());
    for (std::size_t f = 0; f < played.joints.size(); ++f) {
        const double at = static_cast<double>(f) * pace;
        for (std::size_t j = 0; j < kBodyBones.size(); ++j) {
            played.joints[f][j] =
                between([&](std::size_t i) { return track.joints[i][j]; }, track.frames(), at);
        }
        for (std::size_t side = 0; side < 2; ++side) {
            SourceFoot& foot = played.feet[f][side];
            foot.ankle = between(
                [&](std::size_t i) { return track.feet[i][side].ankle; }, track.frames(), at);
            foot.toe_tip = between(
                [&](std::size_t i) { return track.feet[i][side].toe_tip; }, track.frames(), at);
        }
    }
    return played;
}

MetricFrames frames_at_pace(const MetricFrames& frames, std::size_t count, double pace) {
    MetricFrames played;
    for (std::size_t f = 0; f < frames_played(count, pace); ++f) {
        const double at = static_cast<double>(f) * pace;
        // A frame counts if both original ones around it do.
        const std::size_t below = std::min(static_cast<std::size_t>(at), count - 1);
        const std::size_t above = std::min(below + 1, count - 1);
        played.counted.push_back(frames.is_counted(below) && frames.is_counted(above));
        played.pace.push_back(pace);
    }
    return played;
}

double JerkSquares::rms() const noexcept { return count > 0.0 ? std::sqrt(sum / count) : 0.0; }

JerkByPace jerk_by_pace(const BodyTrack& track, const MetricFrames& frames) {
    JerkByPace result;
    for (std::size_t p = 0; p < kJudgedPaces.size(); ++p) {
        const double pace = kJudgedPaces[p];
        const JerkReport jerk =
            jerk_of(played_at_pace(track, pace), frames_at_pace(frames, track.frames(), pace));
        for (const double sample : jerk.samples) {
            result[p].sum += sample * sample;
        }
        result[p].count = static_cast<double>(jerk.samples.size());
    }
    return result;
}

}  // namespace raks::motion
