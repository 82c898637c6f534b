#include "motion/evaluate/published_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/statistics.hpp"
#include "motion/evaluate/dance_metrics.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kKernelFrames = 3.0;      // s of the score
constexpr double kSmoothingFrames = 5.0;   // Bailando
constexpr std::size_t kMinimumOrder = 10;  // FACT: frames to each side

// Summed speed of all joints from each frame to the next, metres a frame.
std::vector<double> summed_speeds(const BodyTrack& track) {
    std::vector<double> sums;
    for (std::size_t f = 0; f + 1 < track.frames(); ++f) {
        double sum = 0.0;
        for (std::size_t j = 0; j < kBodyBones.size(); ++j) {
            sum += glm::length(track.joints[f + 1][j] - track.joints[f][j]);
        }
        sums.push_back(sum);
    }
    return sums;
}

// scipy.ndimage.gaussian_filter1d: cut at 4 sigma, ends reflected with the last value repeated.
std::vector<double> gaussian_smoothed(const std::vector<double>& values, double sigma) {
    const auto reach = static_cast<std::ptrdiff_t>(std::lround(4.0 * sigma));
    std::vector<double> taps;
    double sum = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        taps.push_back(std::exp(-0.5 * std::pow(static_cast<double>(k) / sigma, 2.0)));
        sum += taps.back();
    }
    const auto count = static_cast<std::ptrdiff_t>(values.size());
    const auto reflected = [&](std::ptrdiff_t i) {
        const std::ptrdiff_t period = 2 * count;
        const std::ptrdiff_t place = ((i % period) + period) % period;
        return values[static_cast<std::size_t>(place < count ? place : period - 1 - place)];
    };
    std::vector<double> result(values.size(), 0.0);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
            result[static_cast<std::size_t>(i)] +=
                taps[static_cast<std::size_t>(k + reach)] / sum * reflected(i + k);
        }
    }
    return result;
}

// Places lower than all of `order` neighbours to each side; beyond an end its value stands, so
// that the ends themselves are none (scipy.signal.argrelextrema, mode "clip").
std::vector<double> minima(const std::vector<double>& values, std::size_t order) {
    std::vector<double> found;
    for (std::size_t i = 0; i < values.size(); ++i) {
        bool is_lowest = true;
        for (std::size_t d = 1; d <= order && is_lowest; ++d) {
            const double before = values[i >= d ? i - d : 0];
            const double after = values[std::min(i + d, values.size() - 1)];
            is_lowest = values[i] < before && values[i] < after;
        }
        if (is_lowest) {
            found.push_back(static_cast<double>(i));
        }
    }
    return found;
}

// The beats within the track, in fractional frames.
std::vector<double> beats_in_frames(const BodyTrack& track, std::span<const double> beat_times) {
    std::vector<double> frames;
    for (const double time : beat_times) {
        const double frame = time * track.frames_per_second;
        if (frame >= 0.0 && frame < static_cast<double>(track.frames())) {
            frames.push_back(frame);
        }
    }
    return frames;
}

// Mean over `beats` of the score of the distance to the nearest of `others`; 0 without beats on
// either side.
double mean_score(const std::vector<double>& beats, const std::vector<double>& others) {
    if (beats.empty() || others.empty()) {
        return 0.0;
    }
    double sum = 0.0;
    for (const double beat : beats) {
        double nearest = std::abs(others.front() - beat);
        for (const double other : others) {
            nearest = std::min(nearest, std::abs(other - beat));
        }
        sum += std::exp(-nearest * nearest / (2.0 * kKernelFrames * kKernelFrames));
    }
    return sum / static_cast<double>(beats.size());
}

}  // namespace

double motion_beat_alignment(const BodyTrack& track, std::span<const double> beat_times) {
    // FACT counts the speed of a frame as that into it; the first frame has none and gets zero.
    std::vector<double> speed = summed_speeds(track);
    speed.insert(speed.begin(), 0.0);
    return mean_score(minima(speed, kMinimumOrder), beats_in_frames(track, beat_times));
}

double music_beat_alignment(const BodyTrack& track, std::span<const double> beat_times) {
    std::vector<double> speed = summed_speeds(track);
    for (double& value : speed) {
        // A factor does not move the minima; kept as in Bailando's program.
        value /= static_cast<double>(kBodyBones.size());
    }
    return mean_score(beats_in_frames(track, beat_times),
                      minima(gaussian_smoothed(speed, kSmoothingFrames), 1));
}

namespace {

constexpr double kRate = 30.0;         // frames a second of both definitions
constexpr double kAnkleHeight = 0.08;  // metres over the floor
constexpr double kToeHeight = 0.05;    // metres over the floor
constexpr double kSkating = 0.01;      // metres a frame
constexpr double kFloorShare = 0.05;   // percentile of the toe tip's heights taken as the floor
constexpr double kContactScale = 1e4;  // EDGE's factor

// Every stride-th frame, not filtered.
BodyTrack at_30_frames_a_second(const BodyTrack& track) {
    const auto stride =
        static_cast<std::size_t>(std::max(1.0, std::nearbyint(track.frames_per_second / kRate)));
    BodyTrack thinned;
    thinned.frames_per_second = track.frames_per_second / static_cast<double>(stride);
    for (std::size_t f = 0; f < track.frames(); f += stride) {
        thinned.joints.push_back(track.joints[f]);
        thinned.feet.push_back(track.feet[f]);
    }
    return thinned;
}

// Horizontal distance.
double step(const glm::dvec3& from, const glm::dvec3& to) {
    return std::hypot(to.x - from.x, to.z - from.z);
}

// Of ankle and toe tip the slower one: while heel or toe is down, one of them rests.
double slower_step(const SourceFoot& from, const SourceFoot& to) {
    return std::min(step(from.ankle, to.ankle), step(from.toe_tip, to.toe_tip));
}

// As defined by Lodge: the mean of both horizontal velocities, not their length.
bool slides(const glm::dvec3& from, const glm::dvec3& to) {
    return std::abs((to.x - from.x + to.z - from.z) / 2.0) > kSkating;
}

// The ratio of one foot.
double skating_of(const BodyTrack& track, Side side) {
    const std::size_t s = static_cast<std::size_t>(side);
    std::vector<double> heights;
    for (const auto& feet : track.feet) {
        heights.push_back(feet[s].toe_tip.y);
    }
    // The floor of a capture is not known exactly.
    const double floor = percentile(heights, kFloorShare);
    std::size_t down = 0;
    std::size_t skating = 0;
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const SourceFoot& foot = track.feet[f][s];
        if (foot.ankle.y > floor + kAnkleHeight || foot.toe_tip.y > floor + kToeHeight) {
            continue;
        }
        ++down;
        // The last frame is down, but has no speed.
        if (f + 1 < track.frames()) {
            const SourceFoot& next = track.feet[f + 1][s];
            const bool is_sliding =
                slides(foot.ankle, next.ankle) || slides(foot.toe_tip, next.toe_tip);
            skating += is_sliding ? 1 : 0;
        }
    }
    return down == 0 ? 0.0 : static_cast<double>(skating) / static_cast<double>(down);
}

}  // namespace

double physical_foot_contact(const BodyTrack& given) {
    const BodyTrack track = at_30_frames_a_second(given);
    if (track.frames() < 3) {
        return 0.0;
    }
    const double squared_rate = track.frames_per_second * track.frames_per_second;
    double highest = 0.0;
    double sum = 0.0;
    for (std::size_t f = 0; f + 2 < track.frames(); ++f) {
        glm::dvec3 acceleration = (track.joints[f + 2][kHips] - 2.0 * track.joints[f + 1][kHips] +
                                   track.joints[f][kHips]) *
                                  squared_rate;
        // The downward part is left out: gravity gives it without any contact.
        acceleration.y = std::max(acceleration.y, 0.0);
        highest = std::max(highest, glm::length(acceleration));
        sum += slower_step(track.feet[f + 1][0], track.feet[f + 2][0]) *
               slower_step(track.feet[f + 1][1], track.feet[f + 2][1]) * glm::length(acceleration);
    }
    const auto frames = static_cast<double>(track.frames() - 2);
    return highest > 0.0 ? kContactScale * sum / (highest * frames) : 0.0;
}

double foot_skating_ratio(const BodyTrack& given) {
    const BodyTrack track = at_30_frames_a_second(given);
    return 0.5 * (skating_of(track, Side::left) + skating_of(track, Side::right));
}

}  // namespace raks::motion
