// The adjustment of a rig to what its cameras saw of a dancer.
#pragma once

#include <array>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/dancer_rig/dancer_sights.hpp"

namespace raks::capture {

/// What is adjusted, and how it is weighed.
struct DancerAdjustment {
    double height = 1.7;            ///< of the dancer, metres
    std::vector<double> errors;     ///< by camera: of a joint in a picture, pixels
    std::vector<bool> free_lenses;  ///< by camera: its focal length is a guess that is refined
};

/// What became of it.
struct AdjustedDancer {
    std::array<double, kLimbLengths> lengths{};  ///< metres
    std::vector<double> camera_rms;              ///< by camera; pixels
    /// How far knees are ahead of the line from hip to ankle, on average; metres. Seen from the
    /// front a body and its mirror image in depth look nearly alike, but the mirrored knees bend
    /// backwards: below 0.
    double knees_ahead = 0.0;
    double cost = 0.0;  ///< half of the weighted sum of squares
};

/// Moves cameras, guessed focal lengths, the joints of all moments and the lengths of the dancer's
/// limbs until what the cameras saw is explained best: least squares with a soft L1 loss, in which
/// limbs keep their lengths and these are near those of a body of that height. The lengths give the
/// world its size, and refine the focal lengths, of which epipolar lines alone say nothing where
/// all cameras look at one point. The first camera stays where it is. Only square pixels are
/// refined; the middle and the distortion of a lens stay. The same input gives the same bits.
/// Error: no finite solution. Threads: any; it uses one. Real-time: no (seconds).
[[nodiscard]] Expected<AdjustedDancer> adjust_to_dancer(Rig& rig,
                                                        const std::vector<DancerMoment>& moments,
                                                        const DancerAdjustment& how);

}  // namespace raks::capture
