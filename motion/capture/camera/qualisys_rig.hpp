// Rigs of Qualisys: the calibration that its track manager exports (.qca.txt, an XML).
#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/capture/camera/rig_file.hpp"

/// The format: `<calibration><cameras>`, for each `<camera serial="...">` with `<fov_video>` (the
/// picture: left, top, right, bottom), `<transform>` (x y z: where it stands, millimetres;
/// r11..r33: world from camera, whose axes are x to the right, y up, z backward) and `<intrinsic>`
/// (focal length and centre in 1/64 pixel; distortion as OpenCV's). z is up. Threads: any.
/// Real-time: no.
namespace raks::capture {

/// Reads a rig. `name`: the file's, for messages. Errors: XML that is none, with its place; no
/// camera or more than 1,000; a part or number of a camera missing; skew; what check_rig refuses;
/// more than 16 MiB.
[[nodiscard]] Expected<RigFile> parse_qualisys_rig(std::string_view text,
                                                   const std::string& name,
                                                   const RigReading& reading = {});

}  // namespace raks::capture
