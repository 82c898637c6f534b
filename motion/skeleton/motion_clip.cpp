#include "motion/skeleton/motion_clip.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kLeastHeight = 0.5;  // metres of a standing body
constexpr double kMostHeight = 2.5;   // metres
constexpr double kUsualHeight = 1.7;  // metres, where no unit fits

}  // namespace

ClipWorldPose world_pose(const MotionClip& clip, std::size_t frame) {
    ClipWorldPose world;
    world.positions.resize(clip.joints.size());
    world.rotations.resize(clip.joints.size());
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const std::size_t parent = clip.joints[joint].parent;
        const glm::dvec3& position = clip.position(frame, joint);
        const glm::dquat& rotation = clip.rotation(frame, joint);
        if (parent == joint) {
            world.positions[joint] = position;
            world.rotations[joint] = rotation;
        } else {
            world.positions[joint] = world.positions[parent] + world.rotations[parent] * position;
            world.rotations[joint] = world.rotations[parent] * rotation;
        }
    }
    return world;
}

std::vector<glm::dvec3> rest_positions(const MotionClip& clip) {
    std::vector<glm::dvec3> places(clip.joints.size());
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const ClipJoint& at = clip.joints[joint];
        // A file whose positions replace its offsets may leave the offsets zero.
        const bool has_offset = at.offset != glm::dvec3(0.0) || clip.frame_count == 0;
        const glm::dvec3 offset =
            has_offset || at.parent == joint ? at.offset : clip.position(0, joint);
        places[joint] = at.parent == joint ? offset : places[at.parent] + offset;
    }
    return places;
}

double guess_metres_per_unit(const MotionClip& clip) {
    if (clip.metres_per_unit) {
        return *clip.metres_per_unit;
    }
    const std::vector<glm::dvec3> places = rest_positions(clip);
    glm::dvec3 low(1e30);
    glm::dvec3 high(-1e30);
    const auto take = [&](const glm::dvec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    };
    for (std::size_t joint = 0; joint < places.size(); ++joint) {
        take(places[joint]);
        if (clip.joints[joint].end_site) {
            take(places[joint] + *clip.joints[joint].end_site);
        }
    }
    const glm::dvec3 extent = high - low;
    // y is up, but a file may have z up: the body is longer than it is deep.
    const double height = std::max(extent.y, extent.z);
    if (!(height > 1e-9)) {
        return 0.01;
    }
    for (const double unit : {0.01, 1.0, 0.001}) {
        if (height * unit >= kLeastHeight && height * unit <= kMostHeight) {
            return unit;
        }
    }
    return kUsualHeight / height;
}

std::size_t leading_rest_frames(const MotionClip& clip) {
    if (clip.frame_count < 3) {
        return 0;
    }
    // A T-pose has no rotation in any joint, which no recorded frame has; the next frame leaves it
    // by a jump.
    const auto largest_turn = [&](std::size_t frame, std::size_t other) {
        double largest = 0.0;
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            const double dot =
                std::abs(glm::dot(clip.rotation(frame, joint), clip.rotation(other, joint)));
            largest = std::max(largest, 2.0 * std::acos(std::min(1.0, dot)));
        }
        return largest;
    };
    double from_rest = 0.0;
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const double w = std::abs(clip.rotation(0, joint).w);
        from_rest = std::max(from_rest, 2.0 * std::acos(std::min(1.0, w)));
    }
    constexpr double kRest = 0.01;  // radians
    constexpr double kJump = 0.1;   // radians
    return from_rest < kRest && largest_turn(0, 1) > kJump ? 1 : 0;
}

}  // namespace raks::motion
