#pragma once

#include <span>
#include <string_view>

#include "motion/skeleton/pose.hpp"

namespace raks::render {

struct NamedPose {
    std::string_view name;
    motion::Pose pose;  ///< hips at the origin: lift it so that the lowest vertex is on the floor
};

/// Twelve postures that show a body's weak spots, for pose sheets and tests: T, bind, cross, down,
/// elbow, hip, knee, over, salsa, squat, twist, wrist.
/// Threads: any. Real-time: no (built on first use).
[[nodiscard]] std::span<const NamedPose> mannequin_test_poses();

/// The pose of that name. The name must be one of the twelve.
[[nodiscard]] const motion::Pose& mannequin_test_pose(std::string_view name);

}  // namespace raks::render
