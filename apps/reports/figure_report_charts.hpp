#pragma once

#include <string>

#include "training/figures/figure_report.hpp"

/// The charts of a training report, one part of the body each; SVG for a page.
namespace raks::apps {

/// The colour of a part in every chart.
[[nodiscard]] const char* colour_of(motion::Part part);

/// Held-out, and below it training log-likelihood against the number of states (Fig. 11).
[[nodiscard]] std::string draw_selection(motion::Part part, const motion::PartSelection& selection);

/// A feature's curve in each shown repeat with the state means on it, side by side (Fig. 12).
[[nodiscard]] std::string draw_curve(motion::Part part,
                                     const motion::FeatureCurve& curve,
                                     const motion::FigureReport& report);

/// Counts against states, as shares of each count (Fig. 13).
[[nodiscard]] std::string draw_occurrence(motion::Part part, const motion::FigureReport& report);

/// How many beats each state lasts: every repeat, mean and standard deviation (Fig. 14).
[[nodiscard]] std::string draw_stays(motion::Part part, const motion::FigureReport& report);

}  // namespace raks::apps
