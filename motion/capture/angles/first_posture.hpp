// First posture: where the labels have a body, and whether they can.
#pragma once

#include <cstddef>
#include <optional>

#include "base/expected.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/capture/solving/frame_system.hpp"
#include "motion/capture/tracking/track_run.hpp"

namespace raks::capture {

/// A posture to begin with.
struct FirstPosture {
    std::size_t frame = 0;
    BodyState state;
};

/// The posture of the frame in which most markers are labelled in two cameras each. None: no frame
/// has 3 markers of the trunk. Errors, one line: labels of which a quarter lies 20 cm or more from
/// where the body can have them; limits of joints without which the posture would lie much nearer
/// to the labels.
[[nodiscard]] Expected<std::optional<FirstPosture>> posture_by_labels(const FrameContext& context,
                                                                      const TrackRunInput& input);

}  // namespace raks::capture
