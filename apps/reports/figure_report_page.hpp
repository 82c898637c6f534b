#pragma once

#include <optional>
#include <string>
#include <vector>

#include "training/figures/classifier_evaluation.hpp"
#include "training/figures/figure_report.hpp"

namespace raks::apps {

/// What `raks train report` found.
struct ReportData {
    std::string dance;
    std::vector<motion::FigureReport> figures;
    std::optional<motion::ClassifierEvaluation> classifier;  ///< with two figures or more
};

/// One HTML page that needs nothing else: for every figure the log-likelihood against the number of
/// states, the state means over a few realizations, counts against states and the states' lengths
/// (the paper's Figs. 11 to 14); then how well the figures are told apart. The same data give the
/// same bytes. Threads: any. Real-time: no.
[[nodiscard]] std::string draw_report(const ReportData& data);

}  // namespace raks::apps
