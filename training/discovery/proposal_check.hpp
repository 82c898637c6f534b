#pragma once

#include <span>
#include <string>
#include <vector>

#include "motion/figures/label_tables.hpp"
#include "training/discovery/clip_discovery.hpp"

/// Proposal check: repeats that were found beside labels that somebody made.
namespace raks::motion {

/// One take that has labels, or none.
struct TakeCheck {
    std::string take;
    double found_seconds = 0.0;        ///< of a repeat; 0: none were found
    std::vector<double> true_seconds;  ///< of its labels, of any figure
    bool is_period_right = false;      ///< within 4 % of one of these
    int labelled = 0;                  ///< labels of the figure
    int hit = 0;  ///< of them, how many have a repeat whose start and end lie within half a beat
    int all_labelled = 0;  ///< the same for labels of any figure but "idle"
    int all_hit = 0;
};

/// Compares each clip with the labels of its take, role and of at least `min_confidence`; of the
/// split, if one is given. Period and figures of takes without labels are not judged
/// (true_seconds is empty).
[[nodiscard]] std::vector<TakeCheck> check_proposal(const DiscoveredClips& found,
                                                    std::span<const FigureLabel> labels,
                                                    const FigureTrainingPlan& plan);

}  // namespace raks::motion
