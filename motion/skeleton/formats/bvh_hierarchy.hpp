// BVH hierarchy: the part of a BVH file before MOTION.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/formats/motion_text.hpp"
#include "motion/skeleton/motion_clip.hpp"

namespace raks::motion {

/// The six channels of a BVH joint, in the order of their codes: X, Y, Z position, X, Y, Z
/// rotation.
enum class BvhChannel : std::uint8_t {
    x_position,
    y_position,
    z_position,
    x_rotation,
    y_rotation,
    z_rotation
};

/// Joints and channels of a BVH file.
struct BvhHierarchy {
    std::vector<ClipJoint> joints;                  ///< parents before their children
    std::vector<std::vector<BvhChannel>> channels;  ///< by joint
    std::size_t channel_count = 0;                  ///< of all joints together: numbers in a frame
    int roots = 0;                                  ///< number of ROOT joints
};

/// Reads from HIERARCHY up to MOTION; `text` is then past that line. Errors: the line and what is
/// wrong.
[[nodiscard]] Expected<BvhHierarchy> read_bvh_hierarchy(MotionText& text);

}  // namespace raks::motion
