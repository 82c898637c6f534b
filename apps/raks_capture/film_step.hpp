// Film step: what the cameras of a capture saw, found in their films where that is still to be
// done.
#pragma once

#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/pictures/chroma.hpp"

namespace raks::apps {

/// detections.csv of a capture. Where the plan names films and the table is not there, or older
/// than a film, the labels or the marker set, it is made from the films first, with a progress
/// line; what is doubtful is said. Errors: as detect_in_films, stopped by a signal, neither films
/// nor table.
[[nodiscard]] Expected<capture::Observations> seen_by_cameras(
    const CapturePlan& plan,
    const capture::Rig& rig,
    const capture::MarkerSet& markers,
    const std::vector<capture::MarkerLabel>& labels,
    capture::ChromaForm form);

}  // namespace raks::apps
