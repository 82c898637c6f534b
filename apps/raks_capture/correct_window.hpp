// Correct window: tracks are looked at, and put right.
#pragma once

#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/tracking_step.hpp"

namespace raks::apps {

/// Opens a window in which tracks are corrected, and edits written to edits.jsonl of the capture as
/// often as the person says so. Returns when it is closed. Errors: no display; what track_with
/// refuses. Threads: main.
[[nodiscard]] Expected<void> correct_in_window(const CapturePlan& plan, const TrackingGiven& given);

}  // namespace raks::apps
