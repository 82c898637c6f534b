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

/// Labels within so many seconds of each other are of one moment.
inline constexpr double kOneMoment = 0.04;

/// What is known of a capture when it is labelled.
struct LabelledCapture {
    const CapturePlan& plan;
    const capture::MarkerSet& markers;
    const capture::Rig* rig = nullptr;            ///< null: not calibrated yet
    const capture::Observations* seen = nullptr;  ///< null: the films are not searched yet
    std::vector<capture::Clock> clocks;           ///< empty: not synchronised yet
};

/// Checks what no label may be, one line that names it: of a camera or marker that the capture has
/// not (with the nearest name), at a pixel outside of the picture, in a picture that the film has
/// not.
[[nodiscard]] Expected<void> check_label_places(const std::vector<capture::MarkerLabel>& labels,
                                                const LabelledCapture& capture);

/// Checks labels. Result: what is doubtful, one line each: markers that nobody labelled, or in one
/// camera alone, or never in two at one moment (within 40 ms); labels that lie on a spot of another
/// colour, where spots are known. Errors: as
/// check_label_places; no marker that is labelled in two cameras at one moment.
[[nodiscard]] Expected<std::vector<std::string>> check_labels(
    const std::vector<capture::MarkerLabel>& labels, const LabelledCapture& capture);

}  // namespace raks::apps
