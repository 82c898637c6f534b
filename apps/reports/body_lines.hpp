// Body lines: a posture as a few lines on a page.
#pragma once

#include <string>
#include <string_view>

#include "motion/skeleton/pose.hpp"

namespace raks::apps {

inline constexpr double kBodyPixels = 84.0;                  ///< height with raised arms
inline constexpr std::string_view kLeftColour = "#2563eb";   ///< of left arm and leg
inline constexpr std::string_view kRightColour = "#ea580c";  ///< of right arm and leg
inline constexpr std::string_view kTrunkColour = "#334155";  ///< of trunk and head

/// SVG paths of one body about (x, ground) in pixels, seen from the front of `heading` (radians).
[[nodiscard]] std::string body_lines(const motion::Pose& pose,
                                     double heading,
                                     double x,
                                     double ground);

}  // namespace raks::apps
