// Capture charts: the pictures in a capture's report.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/raks_capture/body_facts.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::apps {

/// The room from above: the cameras with what they see at the sides of their pictures, and where
/// the dance took place; z grows downwards. `tracks` may be null.
[[nodiscard]] std::string draw_room(const capture::Rig& rig, const capture::Tracks* tracks);

/// A row of time for each marker: seen, filled, lost; flags as a line below.
[[nodiscard]] std::string draw_visibility(const capture::Tracks& tracks);

/// How well one marker's place is known over time, millimetres; `errors` as CaptureReport's, drawn
/// over it where there are any. `most`: the end of the vertical axis, millimetres, > 0.
[[nodiscard]] std::string draw_deviation(const capture::Tracks& tracks,
                                         const std::vector<double>& errors,
                                         std::size_t marker,
                                         double most);

/// Stick figures side by side.
[[nodiscard]] std::string draw_strip(const std::vector<StickPicture>& pictures);

}  // namespace raks::apps
