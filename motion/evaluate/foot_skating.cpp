#include "motion/evaluate/foot_skating.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motion/evaluate/dance_metrics.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
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
