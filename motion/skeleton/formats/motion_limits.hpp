// Limits of motion files: beyond them a file is damaged, or is no motion.
#pragma once

#include <cstddef>

namespace raks::motion {

inline constexpr std::size_t kMostJoints = 1000;             ///< or points
inline constexpr double kLargestMotionNumber = 1e6;          ///< of a place, in file units
inline constexpr double kMostDeclaredFrames = 1e7;           ///< a count in a head
inline constexpr double kLeastRate = 0.01;                   ///< frames a second
inline constexpr double kLargestRate = 1e6;                  ///< frames a second
inline constexpr std::size_t kMostJointFrames = 40'000'000;  ///< joints x frames: 2 GiB of a clip

}  // namespace raks::motion
