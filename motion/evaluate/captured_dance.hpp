#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/evaluate/dance_measures.hpp"
#include "motion/evaluate/landing_error.hpp"
#include "motion/evaluate/played_at_pace.hpp"
#include "motion/figures/figure_model.hpp"

namespace raks::motion {

/// Clips of people and what is known of them: see label_tables.hpp.
struct CapturedDancePlan {
    std::filesystem::path folder;  ///< TAKE.bvh
    std::filesystem::path labels;
    std::optional<std::filesystem::path> counts;
    std::optional<std::filesystem::path> faults;
    DanceRole role = DanceRole::lead;
    std::optional<double> frames_per_second;  ///< instead of the file's
    double metres_per_unit = 1.0;
    double min_confidence = 0.7;  ///< of a repeat, to be compared with others and landings
};

/// One take: from its first figure to its last, without what is labelled idle and without faults;
/// "other" is danced, but no figure.
struct CapturedDance {
    std::string take;
    DanceMeasures measures;
    LandingReport landing;  ///< against the learnt offsets of `models`
    JerkByPace jerk_by_pace;
};

/// Takes of the role that have labels, by name. The counts stand for the music's beats. A fault of
/// more than half a second in head or hands alone (a take's head is wrong throughout) is not
/// masked; a take that is all fault is left out. Errors: of the readers; no take.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::vector<CapturedDance>> measure_captured(
    const CapturedDancePlan& plan, std::span<const FigureModel> models);

}  // namespace raks::motion
