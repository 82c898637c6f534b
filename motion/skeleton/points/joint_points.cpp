#include "motion/skeleton/points/joint_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::motion {
namespace {

// How a clip lies in the world.
struct Lie {
    double metres_per_unit = 1.0;
    glm::dquat upright{1.0, 0.0, 0.0, 0.0};
};

// The points of a skeleton: its joints, then the tips of those that have one.
void name_points(const MotionClip& clip, WorldPoints& points) {
    points.named = clip.joints.size();
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        points.clip.names.push_back(clip.joints[joint].name);
        if (const std::size_t parent = clip.joints[joint].parent; parent != joint) {
            points.edges.push_back({parent, joint});
        }
    }
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        if (clip.joints[joint].end_site) {
            points.edges.push_back({joint, points.clip.names.size()});
            points.clip.names.push_back(clip.joints[joint].name + " tip");
        }
    }
}

void place_points(const MotionClip& clip, const Lie& lie, WorldPoints& points) {
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ClipWorldPose world = world_pose(clip, frame);
        for (const glm::dvec3& place : world.positions) {
            points.clip.positions.push_back(lie.metres_per_unit * (lie.upright * place));
        }
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            if (const auto& tip = clip.joints[joint].end_site) {
                points.clip.positions.push_back(
                    lie.metres_per_unit *
                    (lie.upright * (world.positions[joint] + world.rotations[joint] * *tip)));
            }
        }
    }
}

// Where a bone is among the named points.
std::optional<std::size_t> point_of(const WorldPoints& points, Bone bone) {
    const auto at = std::find(points.bones.begin(), points.bones.end(), bone);
    return at == points.bones.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(at - points.bones.begin()));
}

}  // namespace

double facing_of(const WorldPoints& points) {
    constexpr double kOnTheWhole = 0.4;  // length of a mean of directions
    constexpr double kNearly = 0.5;      // radians that are no other way
    const auto left = point_of(points, Bone::left_upper_leg);
    const auto right = point_of(points, Bone::right_upper_leg);
    if (!left || !right) {
        return 0.0;
    }
    const auto ahead = [&](std::size_t frame) {
        const glm::dvec3 across =
            points.clip.position(frame, *left) - points.clip.position(frame, *right);
        const glm::dvec3 way(-across.z, 0.0, across.x);
        return glm::length(way) > 0.0 ? glm::normalize(way) : glm::dvec3(0.0);
    };
    glm::dvec3 mean(0.0);
    for (std::size_t frame = 0; frame < points.clip.frame_count; ++frame) {
        mean += ahead(frame) / static_cast<double>(points.clip.frame_count);
    }
    const glm::dvec3 face = glm::length(mean) > kOnTheWhole ? mean : ahead(0);
    const double facing = std::atan2(face.x, face.z);
    return std::abs(facing) > kNearly ? facing : 0.0;
}

void turn_about_y(WorldPoints& points, double radians) {
    if (radians == 0.0) {
        return;
    }
    const glm::dquat turn = glm::angleAxis(radians, glm::dvec3(0.0, 1.0, 0.0));
    for (glm::dvec3& place : points.clip.positions) {
        place = turn * place;
    }
}

WorldPoints joint_points(const MotionClip& clip, const BodyOptions& options) {
    WorldPoints points;
    points.clip.frames_per_second = clip.frames_per_second;
    points.clip.frame_count = clip.frame_count;
    points.clip.metres_per_unit = 1.0;
    points.clip.up = glm::dvec3(0.0, 1.0, 0.0);
    points.bones.resize(clip.joints.size());
    Lie lie;
    if (const auto body = find_body(clip, options)) {
        lie = {body->size.metres_per_unit, body->up.upright};
        const auto& joints = body->mapping().joints;
        for (std::size_t bone = 0; bone < joints.size(); ++bone) {
            if (joints[bone]) {
                points.bones[*joints[bone]] = static_cast<Bone>(bone);
            }
        }
    } else {
        lie.metres_per_unit = options.metres_per_unit.value_or(guess_metres_per_unit(clip));
        lie.upright = turn_to_y(options.up.value_or(clip.up.value_or(*points.clip.up)));
    }
    name_points(clip, points);
    place_points(clip, lie, points);
    return points;
}

WorldPoints world_points(PointClip clip,
                         double metres_per_unit,
                         const glm::dvec3& up,
                         std::vector<PointEdge> edges) {
    const glm::dquat upright = turn_to_y(up);
    for (glm::dvec3& place : clip.positions) {
        place = metres_per_unit * (upright * place);
    }
    clip.metres_per_unit = 1.0;
    clip.up = glm::dvec3(0.0, 1.0, 0.0);
    WorldPoints points;
    points.named = clip.names.size();
    points.clip = std::move(clip);
    points.edges = std::move(edges);
    return points;
}

}  // namespace raks::motion
