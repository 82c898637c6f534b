#include "motion/evaluate/played_at_pace.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
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
