// Stance finder: where the floor of a clip is, and which way its body faces.
#pragma once

#include "motion/skeleton/body/posed_body.hpp"

#include <glm/gtc/quaternion.hpp>

namespace raks::motion {

/// How a body stands in its file, once up is known.
struct FoundStance {
    double floor = 0.0;             ///< height of the floor along up; file units
    double floor_confidence = 0.0;  ///< share of the frames in which a foot is on it
    /// Way that the body faces in the first frame, about up: 0 is the +z of the turned world, +90
    /// its +x; degrees. Of a clip in a model: that it faces at rest.
    double facing = 0.0;
    double facing_confidence = 0.0;  ///< share of feet and bent knees that point that way
};

/// The floor is the 5th percentile of the toe tips' heights; a foot is on it within a 20th of the
/// body's height. The body faces across the line of its hip sockets, from left to right; toes ahead
/// of the ankles and knees ahead of the legs' lines agree or do not. `upright`: turns the file's
/// world to y up; `height`: of the body, file units.
[[nodiscard]] FoundStance find_stance(const PosedBody& body,
                                      const glm::dquat& upright,
                                      double height);

}  // namespace raks::motion
