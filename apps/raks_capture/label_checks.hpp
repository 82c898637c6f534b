// Label checks: whether labels fit the capture that they are for.
#pragma once

#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"

namespace raks::apps {

/// What is known of a capture when it is labelled.
struct LabelledCapture {
    const CapturePlan& plan;
    const capture::MarkerSet& markers;
    const capture::Rig* rig = nullptr;            ///< null: not calibrated yet
    const capture::Observations* seen = nullptr;  ///< null: the films are not searched yet
    std::vector<capture::Clock> clocks;           ///< empty: not synchronised yet
};

/// Checks labels. Result: what is doubtful, one line each: markers that nobody labelled, or in one
/// camera alone, or never in two at one moment (within 40 ms); labels that lie on a spot of another
/// colour, where spots are known. Errors, one line that names the label: a camera or marker that
/// the capture has not (with the nearest name), a pixel outside of the picture, a picture that the
/// film has not; no marker that is labelled in two cameras at one moment.
[[nodiscard]] Expected<std::vector<std::string>> check_labels(
    const std::vector<capture::MarkerLabel>& labels, const LabelledCapture& capture);

}  // namespace raks::apps
