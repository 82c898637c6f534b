// Tracks as a C3D, which every motion program reads.
#pragma once

#include <string>

#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// Tracks as a C3D (c3d.org, user guide 2008): Intel's byte order, floats in metres, y up; places
/// that are lost have a negative residual. More than 65,535 frames are told as TRIAL's fields have
/// them. At most 255 markers are written. The same tracks give the same bytes.
[[nodiscard]] std::string c3d_bytes(const Tracks& tracks);

}  // namespace raks::capture
