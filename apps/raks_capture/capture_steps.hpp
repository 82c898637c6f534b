// Capture steps: what `raks capture run` does, in which order, and what of it is to be done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/raks_capture/capture_plan.hpp"

namespace raks::apps {

/// One step from films to a dance: a command on the folder of a capture.
struct CaptureStep {
    std::string command;                 ///< "track"
    std::vector<std::string> arguments;  ///< that follow the folder
    /// Files and folders that it reads; those that are not there do not count.
    std::vector<std::filesystem::path> inputs;
    std::vector<std::filesystem::path> outputs;  ///< what it makes
    /// There is something to make the outputs from. Else they are given, as by another program.
    bool has_source = true;
};

/// The steps of a capture, in order: calibrate, sync, track, solve, report. Where each film shows
/// board and dance, its clock is that of both: sync comes first, and calibrate takes clocks.toml.
/// Calibration films of their own are synchronised before calibrate; folders of pictures are not.
/// Without markers: keypoints, sync, calibrate by the dancer, track, solve, report.
[[nodiscard]] std::vector<CaptureStep> capture_steps(const CapturePlan& plan);

/// What is to be done about a step.
enum class StepState {
    missing,     ///< an output is not there
    outdated,    ///< an output is older than an input
    up_to_date,  ///< neither
    given        ///< its outputs are there, and nothing that it could make them from
};

/// Looks at the times of its files; to be asked just before the step, since those before it change
/// its inputs. Never fails: a file whose time cannot be read counts as not there.
[[nodiscard]] StepState state_of(const CaptureStep& step);

}  // namespace raks::apps
