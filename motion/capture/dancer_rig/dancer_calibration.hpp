// The calibration of a rig by the dancer alone, without a board.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/dancer_rig/dancer_adjustment.hpp"
#include "motion/capture/dancer_rig/dancer_sights.hpp"
#include "motion/capture/markerless/dancer_floor.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"

namespace raks::capture {

inline constexpr double kGuessedView = 60.0;     ///< degrees across the longer side of a picture
inline constexpr double kUsualHeight = 1.70;     ///< of a dancer, metres, where nobody said it
inline constexpr double kLeastPairAngle = 30.0;  ///< degrees between two cameras, at the dancer
inline constexpr double kMostPairAngle = 150.0;  ///< likewise

/// A camera that filmed the dancer.
struct DancerCamera {
    std::string name;
    int width = 0;                 ///< of its pictures; pixels
    int height = 0;                ///< likewise
    std::optional<Lens> lens{};    ///< where it is known; none: guessed, and refined
    bool is_surely_still = false;  ///< known by its background (surely_stood_still)
};

/// A rig that was calibrated by a dancer.
struct DancerCalibration {
    Rig rig;  ///< metres, y up, the floor y = 0; the dancer about the origin, the first camera at z
              ///< > 0
    std::vector<CameraPair> pairs;  ///< all that could be found
    AdjustedDancer adjusted;
    DancerFloor floor;
    std::vector<std::string> doubts;  ///< one line each
};

/// The lens that is assumed where none is known: kGuessedView across the longer side.
[[nodiscard]] Lens guessed_lens(int width, int height);

/// Calibrates: how each two cameras stand to one another by an essential matrix from the joints of
/// the whole take, all of them together by adjust_to_dancer(), then the floor. `cameras`: as in the
/// take. `height`: of the dancer, metres; the size of the world follows from it. Errors, one line
/// that says what to film: cameras that see the dancer too seldom together; cameras that stand
/// opposite one another or less than 30 degrees apart, where no other camera helps; views that
/// contradict one another. The same input gives the same bits. Threads: any; it uses one.
/// Real-time: no (seconds).
[[nodiscard]] Expected<DancerCalibration> calibrate_by_dancer(
    const KeypointTake& take, const std::vector<DancerCamera>& cameras, double height);

}  // namespace raks::capture
