#include "motion/evaluate/repeat_distance.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::motion {
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
