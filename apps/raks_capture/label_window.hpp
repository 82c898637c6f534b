// Label window: markers of first pictures are clicked and named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "base/expected.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::apps {

/// What is labelled.
struct LabelWork {
    const CapturePlan& plan;
    const capture::MarkerSet& markers;
    std::vector<capture::MarkerLabel> labels;  ///< so far
    capture::Rig rig;                          ///< without cameras: not calibrated yet
    capture::Observations seen;                ///< without films: they are not searched yet
    std::vector<capture::Clock> clocks;        ///< empty: not synchronised yet
};

/// Opens a window in which labels are made, and written to labels.tsv of the capture as often as
/// the person says so. Returns when it is closed. Errors: no display, neither films nor spots.
/// Threads: main.
[[nodiscard]] Expected<void> label_in_window(const LabelWork& work);

}  // namespace raks::apps
