// Standing cameras: whether cameras stood as they do now while they filmed a dancer.
#pragma once

#include <string>
#include <vector>

#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markerless/keypoint_take.hpp"

namespace raks::capture {

/// What speaks against cameras that stand still, with still lenses, by the distances of joints from
/// each other's epipolar lines, second by second: a camera that was moved at some moment, one that
/// zooms, one that moves all the time (held in a hand, or by a stabilising phone). One line each;
/// two cameras cannot tell which of them it is, more do. What moves a picture along the epipolar
/// lines alone, as a slow turn of an upright camera does, cannot be seen by two cameras; nor can
/// anything in a take of less than six seconds. `rig`: its cameras are those of the take.
/// `are_still`: by camera, whether it is known by other means that it stood still; of two such
/// cameras only their clocks are doubted. Threads: any. Real-time: no.
[[nodiscard]] std::vector<std::string> standing_doubts(const Rig& rig,
                                                       const KeypointTake& take,
                                                       const std::vector<bool>& are_still);

}  // namespace raks::capture
