// Captured dance: measures people's takes with the metrics of this folder.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/evaluate/dance_measures.hpp"
#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/formats/motion_file.hpp"

namespace raks::motion {

/// Takes of people and their tables (label_tables.hpp).
struct CapturedDancePlan {
    std::filesystem::path folder;  ///< of the clips: TAKE.bvh, or another format
    std::filesystem::path labels;  ///< table of figures
    /// Table of counts; none: counts are even within a label
    std::optional<std::filesystem::path> counts;
    std::optional<std::filesystem::path> faults;  ///< table of capture faults
    DanceRole role = DanceRole::lead;             ///< whose clips are measured
    MotionReadOptions reading;                    ///< of the clips; with another rate
    double metres_per_unit = 1.0;                 ///< of the clips
    JointLabels joints{};                         ///< which joint of the clips is which bone
    double min_confidence = 0.7;  ///< of a label, to count as a repeat and for landings
};

/// Measures of one take, from its first figure to its last, without idle stretches and faults. What
/// is labelled "other" counts as dancing, but not as a figure.
struct CapturedDance {
    std::string take;         ///< name
    DanceMeasures measures;   ///< all metrics but landings
    LandingReport landing;    ///< against the learnt landings of `models`
    JerkByPace jerk_by_pace;  ///< jerk if it were danced at other tempi
};

/// Measures all takes of the role that have labels, by name. The counts serve as the music's beats.
/// A fault of more than half a second in head or hands alone is not masked (one take's head is
/// wrong throughout); a take that is all fault is left out. Errors: of the readers; no take.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<CapturedDance>> measure_captured(
    const CapturedDancePlan& plan, std::span<const FigureModel> models);

}  // namespace raks::motion
