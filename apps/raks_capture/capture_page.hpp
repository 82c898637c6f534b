// Capture page: the report of a capture, as one HTML page.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/body_facts.hpp"
#include "motion/capture/angles/unsure_joints.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/markers/marker_set.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/tracking/camera_moves.hpp"

namespace raks::apps {

/// What a report is made of. Parts that are not there yet are left out of the page.
struct CaptureReport {
    std::string name;  ///< of the capture
    std::optional<capture::Rig> rig;
    std::vector<capture::Clock> clocks;
    std::optional<capture::MarkerSet> markers;
    std::optional<capture::Tracks> tracks;
    /// Distance of each place from the truth, frames x markers, metres; NaN where there is no
    /// truth, infinite where the marker is lost. Empty: the truth is not known.
    std::vector<double> errors;
    std::vector<capture::JointSureness> joints;  ///< where a body was followed by angles
    std::vector<capture::Edit> edits;
    std::vector<capture::CameraMove> moves;
    std::optional<BodyFacts> body;
    /// A film that shows the dance beside others, as the page links it; empty: none.
    std::string film;
};

/// The page: what came of the capture in a sentence, and which cameras were moved; the cameras and
/// the room from above; their clocks; of every marker when it was seen, and how well its place is
/// known; how sure the angles of a followed body are; what is to be looked at; what was corrected;
/// the body and its feet. Self-contained but for the film, in the style of all reports.
[[nodiscard]] std::string capture_page(const CaptureReport& report);

}  // namespace raks::apps
