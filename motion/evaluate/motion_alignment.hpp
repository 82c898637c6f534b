// Motion alignment: where another motion of the same dance would lie best.
#pragma once

#include "base/expected.hpp"
#include "motion/evaluate/body_track.hpp"

#include <glm/vec3.hpp>

namespace raks::motion {

/// How one motion lies against another. A capture without a board knows where the floor and the
/// vertical are, but not where the room's middle is and which way its front.
struct MotionAlignment {
    double turn = 0.0;  ///< about the vertical, then moved; degrees
    glm::dvec3 move{};  ///< metres
    /// Angle between the verticals, by the turn about any axis that would fit best; degrees.
    double tilt = 0.0;
    /// Size of the other motion, by the scale that would fit best with that turn: 1.03 is 3 %
    /// too large.
    double scale = 1.0;
};

/// Turns `other` about the vertical and moves it so that its joints are nearest to those of `one`
/// at the same moments, in the sense of least squares. Its size and its vertical stay as they are,
/// and what they are is told. `shift`: as compare_motions. Errors: no moment in common. Threads:
/// any. Real-time: no.
[[nodiscard]] Expected<MotionAlignment> align_motion(const BodyTrack& one,
                                                     BodyTrack& other,
                                                     double shift = 0.0);

}  // namespace raks::motion
