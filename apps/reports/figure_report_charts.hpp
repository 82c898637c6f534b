#pragma once

#include <string>

#include "training/figures/figure_report.hpp"

/// The charts of a training report, each of one part of the body, as SVG for a page. Threads: any.
/// Real-time: no.
namespace raks::apps {

/// The colour of a part in every chart, as "#rrggbb".
[[nodiscard]] const char* colour_of(motion::Part part);

/// Held-out log-likelihood against the number of states, and below it that of the training (Fig.
/// 11).
[[nodiscard]] std::string draw_selection(motion::Part part, const motion::PartSelection& selection);

/// A feature's curve in each shown repeat, with the means of the states along its path, side by
/// side (Fig. 12).
[[nodiscard]] std::string draw_curve(motion::Part part,
                                     const motion::FeatureCurve& curve,
                                     const motion::FigureReport& report);

/// Share of each count that is spent in each state, as a table of shades (Fig. 13).
[[nodiscard]] std::string draw_occurrence(motion::Part part, const motion::FigureReport& report);

/// Durations of the states in beats: every repeat, mean and standard deviation (Fig. 14).
[[nodiscard]] std::string draw_stays(motion::Part part, const motion::FigureReport& report);

}  // namespace raks::apps
