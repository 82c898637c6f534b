#include "motion/evaluate/repeat_measures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/evaluate/body_track.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// Largest horizontal distance of any two places.
double widest(const Places& places) {
    double widest = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            widest =
                std::max(widest, std::hypot(places[i].x - places[k].x, places[i].z - places[k].z));
        }
    }
    return widest;
}

// The places of the counted frames in [first, last).
Places counted_places(const Places& places,
                      std::size_t first,
                      std::size_t last,
                      const MetricFrames& frames) {
    Places counted;
    for (std::size_t f = first; f < last; ++f) {
        if (frames.is_counted(f)) {
            counted.push_back(places[f]);
        }
    }
    return counted;
}

// Highest speed of the counted frames; filtered first, as differences amplify noise.
double peak_speed(const Places& places,
                  double frames_per_second,
                  std::size_t first,
                  std::size_t last,
                  const MetricFrames& frames) {
    const std::vector<double> speed = speeds(smoothed(places), frames_per_second);
    double highest = 0.0;
    for (std::size_t f = first; f < last; ++f) {
        if (frames.is_counted(f)) {
            highest = std::max(highest, speed[f] / frames.pace_at(f));
        }
    }
    return highest;
}

}  // namespace

Amplitude amplitude_of(const BodyTrack& track,
                       std::size_t first,
                       std::size_t last,
                       const MetricFrames& frames) {
    Amplitude amplitude;
    amplitude.hips_travel = widest(counted_places(joint_places(track, kHips), first, last, frames));
    // Keeps the larger of both feet.
    const auto raise = [](double& highest, double value) { highest = std::max(highest, value); };
    // Of the stretch, divided by the pace frame by frame.
    const auto peak = [&](const Places& places) {
        return peak_speed(places, track.frames_per_second, first, last, frames);
    };
    for (const Side side : kSides) {
        const Places toe = toe_places(track, side);
        raise(amplitude.toe_travel, widest(counted_places(toe, first, last, frames)));
        raise(amplitude.peak_toe_speed, peak(toe));
        raise(amplitude.peak_ball_speed, peak(foot_places(track, side, kBall)));
    }
    return amplitude;
}

double peak_toe_speed(const BodyTrack& track, const MetricFrames& frames) {
    const auto peak = [&](Side side) {
        return peak_speed(
            toe_places(track, side), track.frames_per_second, 0, track.frames(), frames);
    };
    return std::max(peak(Side::left), peak(Side::right));
}

namespace {

// Index of a bone in kBodyBones.
std::size_t index_in_body(Bone bone) {
    return static_cast<std::size_t>(std::find(kBodyBones.begin(), kBodyBones.end(), bone) -
                                    kBodyBones.begin());
}

using Joints = std::array<glm::dvec3, kBodyBones.size()>;

// Joints in the frame of the pelvis: its front is square to the line between the leg sockets, seen
// from above.
std::array<glm::dvec3, kShapeJoints> heading_local(const Joints& joints) {
    static const std::size_t left = index_in_body(Bone::left_upper_leg);
    static const std::size_t right = index_in_body(Bone::right_upper_leg);
    const glm::dvec3& hips = joints[index_in_body(Bone::hips)];
    const glm::dvec3 to_left = joints[left] - joints[right];
    // Never zero, should that line be vertical.
    const double length = std::max(std::hypot(to_left.x, to_left.z), 1e-9);
    const double cosine = to_left.x / length;
    const double sine = to_left.z / length;
    std::array<glm::dvec3, kShapeJoints> local{};
    std::size_t next = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (kBodyBones[j] == Bone::hips || kBodyBones[j] == Bone::head) {
            continue;
        }
        const double x = joints[j].x - hips.x;
        const double z = joints[j].z - hips.z;
        local[next++] = {cosine * x + sine * z, joints[j].y, cosine * z - sine * x};
    }
    return local;
}

}  // namespace

std::optional<FigureShape> figure_shape(const BodyTrack& track,
                                        std::span<const double> count_times) {
    const double last = static_cast<double>(track.frames()) - 1.0;
    if (count_times.size() < 2 || count_times.front() < 0.0 ||
        count_times.back() * track.frames_per_second > last) {
        return std::nullopt;
    }
    FigureShape shape{};
    for (std::size_t phase = 0; phase < kShapePhases; ++phase) {
        const double count = static_cast<double>(phase * (count_times.size() - 1)) /
                             static_cast<double>(kShapePhases);
        const auto before = static_cast<std::size_t>(count);
        // Linear between two counts, so repeats at different tempi compare phase by phase.
        const double time =
            count_times[before] +
            (count - std::floor(count)) * (count_times[before + 1] - count_times[before]);
        const double frame = time * track.frames_per_second;
        const auto f = static_cast<std::size_t>(frame);
        // Turned first, then interpolated: between two frames the heading hardly changes.
        const auto from = heading_local(track.joints[f]);
        const auto to = heading_local(track.joints[std::min(f + 1, track.frames() - 1)]);
        for (std::size_t j = 0; j < kShapeJoints; ++j) {
            shape[phase][j] = glm::mix(from[j], to[j], frame - std::floor(frame));
        }
    }
    return shape;
}

double rms_distance(const FigureShape& a, const FigureShape& b) {
    double squares = 0.0;
    for (std::size_t phase = 0; phase < kShapePhases; ++phase) {
        for (std::size_t j = 0; j < kShapeJoints; ++j) {
            const glm::dvec3 way = a[phase][j] - b[phase][j];
            squares += glm::dot(way, way);
        }
    }
    return std::sqrt(squares / static_cast<double>(kShapePhases * kShapeJoints));
}

std::vector<double> repeat_distances(std::span<const FigureShape> repeats) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < repeats.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            distances.push_back(rms_distance(repeats[i], repeats[k]));
        }
    }
    return distances;
}

}  // namespace raks::motion
