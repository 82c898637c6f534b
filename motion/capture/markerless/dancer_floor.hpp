// The floor and the vertical of a rig, from a dancer who stands on one and stands upright.
#pragma once

#include <cstddef>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/tracks.hpp"

namespace raks::capture {

/// What was found.
struct DancerFloor {
    std::size_t steps = 0;  ///< stretches of standing feet that it was taken from
    double spread = 0.0;    ///< of their heights over it, RMS; metres
    /// Between the vertical by the feet and that by the body; degrees.
    double disagreement = 0.0;
};

/// Moves a rig so that up is y, the floor is y = 0, the dancer's mean place lies over the origin
/// and the first camera stands at +z. `tracks`: of the keypoints, in the rig's axes. Up is where
/// the centre of mass lies over the feet on average, across what the toes that stand have in
/// common, and across the rows of the pictures, where these are about level: all three together.
/// Errors, one line: feet that are hardly seen; a body that lies.
[[nodiscard]] Expected<DancerFloor> put_on_dancers_floor(Rig& rig,
                                                         const Tracks& tracks,
                                                         double height);

}  // namespace raks::capture
