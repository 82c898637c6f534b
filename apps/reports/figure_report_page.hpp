#pragma once

#include <optional>
#include <string>
#include <vector>

#include "training/figures/classifier_evaluation.hpp"
#include "training/figures/figure_report.hpp"

namespace raks::apps {

/// The results of `raks train report`.
struct ReportData {
    std::string dance;                          ///< its name
    std::vector<motion::FigureReport> figures;  ///< by dancer, then in the order of --figure
    std::optional<motion::ClassifierEvaluation> classifier;  ///< with two figures or more
};

/// One self-contained HTML page: for every figure the log-likelihood against the number of states,
/// the state means over a few repeats, counts against states and the states' durations (the paper's
/// Figs. 11 to 14); then how well the figures are told apart. The same data give the same bytes.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string draw_report(const ReportData& data);

}  // namespace raks::apps
