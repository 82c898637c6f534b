// Capture files: the values that the steps of a capture read from its folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"
#include "motion/capture/angles/angle_track.hpp"
#include "motion/capture/camera/rig.hpp"
#include "motion/capture/markers/edits.hpp"
#include "motion/capture/markers/labels.hpp"
#include "motion/capture/markers/observations.hpp"
#include "motion/capture/markers/tracks.hpp"
#include "motion/capture/solving/body_model.hpp"
#include "motion/capture/tracking/camera_moves.hpp"

namespace raks::apps {

/// rig.toml of a capture, with a line for each doubt. Errors: none there (calibrate first), those
/// of the file.
[[nodiscard]] Expected<capture::Rig> load_capture_rig(const CapturePlan& plan);

/// clocks.toml, with a line for each that drifts by more than 500 ppm. Without the file, where the
/// cameras have no sound to tell: an error that says so.
[[nodiscard]] Expected<std::vector<capture::Clock>> load_clocks(const CapturePlan& plan);

/// detections.csv. Errors: none there, those of the file.
[[nodiscard]] Expected<capture::Observations> load_observations(const CapturePlan& plan);

/// labels.tsv. Errors: none there (label first), those of the file.
[[nodiscard]] Expected<std::vector<capture::MarkerLabel>> load_labels(
    const std::filesystem::path& file);

/// edits.jsonl; none there: no edits. Errors: those of the file.
[[nodiscard]] Expected<std::vector<capture::Edit>> load_edits(const CapturePlan& plan);

/// moved.tsv; none there: none was moved. Errors: those of the file.
[[nodiscard]] Expected<std::vector<capture::CameraMove>> load_moves(const CapturePlan& plan);

/// The body whose joints move: `told`, "dance", "paper" or a file of joints; empty: as the plan has
/// it. Errors: those of the file.
[[nodiscard]] Expected<capture::BodyModel> load_body(const CapturePlan& plan,
                                                     const std::string& told);

/// The postures of angles.csv, by frame; none there, or of another body, which is said: none.
/// Errors: those of the file.
[[nodiscard]] Expected<std::vector<capture::BodyState>> load_angles(const CapturePlan& plan,
                                                                    const capture::BodyModel& body);

/// The track of angles.csv; none there, or of another body: none. Errors: those of the file.
[[nodiscard]] Expected<std::optional<capture::AngleTrack>> load_angle_track(
    const CapturePlan& plan, const capture::BodyModel& body);

/// tracks.csv and flags.tsv of a folder. Errors: none there (track first), those of the files.
[[nodiscard]] Expected<capture::Tracks> load_tracks(const std::filesystem::path& folder);

}  // namespace raks::apps
