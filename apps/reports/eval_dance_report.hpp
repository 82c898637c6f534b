#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/reports/bound.hpp"
#include "apps/reports/eval_dynamics_report.hpp"
#include "engine/trials/dance_trial.hpp"
#include "engine/trials/figure_alone.hpp"
#include "motion/evaluate/captured_dance.hpp"

namespace raks::apps {

/// A measured dance: one trial of the dancer, or one take of people.
struct MeasuredDance {
    std::string name;                       ///< of the trial or take
    std::optional<engine::TrialKind> kind;  ///< none: a take of people
    engine::TrialResult result;         ///< of people only what they have: landings and measures
    motion::JerkByPace jerk_by_pace{};  ///< of people only
};

/// Bounds of the jerk, m/s^3: relative to the people that a dance was learnt from, or, for a
/// written dance, absolute values.
struct JerkStandard {
    std::optional<Bound> rms;      ///< of the root mean square
    std::optional<Bound> p999;     ///< of what a thousandth of the values exceeds
    std::optional<Bound> highest;  ///< of the highest value
};
/// The bounds for a dance and role. Threads: any.
[[nodiscard]] JerkStandard jerk_standard(const DanceInfo& dance, motion::DanceRole role) noexcept;

/// Everything that `raks eval dance` reports.
struct DanceReport {
    DanceInfo dance;                                   ///< that was danced
    motion::DanceRole role = motion::DanceRole::lead;  ///< that was measured
    std::string generator = "trajectories";            ///< its name, as in the settings
    std::int64_t seed = 1;                             ///< of the dancers
    bool is_of_cells = false;                          ///< it was learnt from whole takes
    std::vector<MeasuredDance> trials;  ///< one a trial, in the order of standard_trials()
    std::vector<MeasuredDance> people;  ///< by take, empty without clips
    std::vector<engine::DancedWrittenFigure> written;  ///< each by itself; empty: captured
    std::optional<DynamicsReport> dynamics;            ///< none: they were not measured
};

/// The bounds for the dance of a report: of one of cells, whose takes are danced nearly as they
/// were, the root mean square is at most 1.1 times theirs. Threads: any.
[[nodiscard]] JerkStandard jerk_standard(const DanceReport& report) noexcept;

/// Captured takes as rows of the report. What only a dancer has (pace, re-anchors) stays empty.
[[nodiscard]] std::vector<MeasuredDance> as_rows(std::span<const motion::CapturedDance> takes);
/// RMS of the jerk over all takes, m/s^3, had they been danced at each of motion::kJudgedPaces.
[[nodiscard]] std::array<double, motion::kJudgedPaces.size()> jerk_by_pace(
    std::span<const MeasuredDance> takes);
/// All takes as one row, their samples pooled. `takes`: at least one.
[[nodiscard]] MeasuredDance all_people(std::span<const MeasuredDance> takes);

/// One quantity: a column of the report.
struct DanceQuantity {
    /// The tables that the columns are divided into.
    enum class Topic : std::uint8_t { landing, feet, smoothness, others };
    Topic topic;             ///< whose table it is in
    std::string_view id;     ///< in JSON: "landing_mean_ms"
    std::string_view title;  ///< of the column: "mean ms"
    int digits;              ///< decimals in the text table
    /// Reads it from a dance; nothing where the dance does not have it.
    std::optional<double> (*value)(const MeasuredDance& dance);
    /// Its bound for a kind of trial; nothing: it is only reported.
    std::optional<Bound> (*bound)(engine::TrialKind kind, const JerkStandard& jerk);
};
/// All quantities, topic by topic. Threads: any.
[[nodiscard]] std::span<const DanceQuantity> dance_quantities() noexcept;

/// Bound for the distance of hands that hold one another: 90th percentile in the basic, metres.
inline constexpr Bound kCoupleHands = {.highest = 0.25};  ///< metres, p90 in the basic
/// Least distance skin to skin, metres: legs that step between one another touch; trunks that pass
/// do not.
inline constexpr Bound kPalmsMedian = {.highest = 0.03};  ///< metres between palms while held
inline constexpr Bound kPalmsP90 = {.highest = 0.10};     ///< the same, 90th percentile
inline constexpr Bound kCoupleClosest = {.lowest = -0.05};

/// Distance between two repeats of a written figure, metres; people's salsa: 0.116.
inline constexpr Bound kRepeatDistance = {0.06, 0.14};

/// One figure over several dances.
struct FigureSummary {
    std::string figure;            ///< its name
    std::size_t repeats = 0;       ///< whole repeats that were measured
    double hips_travel = 0.0;      ///< median; metres
    double toe_travel = 0.0;       ///< median; metres
    double peak_toe_speed = 0.0;   ///< median; m/s
    double peak_ball_speed = 0.0;  ///< median; m/s
    /// Median, 10th and 90th percentile of the distance between repeats, metres: of people between
    /// any two, of trials between two of the same trial (the seed is the same in all). Nothing with
    /// less than two repeats.
    std::optional<double> distance_median, distance_p10, distance_p90;
};
/// One summary for each figure that these dances have.
[[nodiscard]] std::vector<FigureSummary> figure_summaries(std::span<const MeasuredDance> dances);

/// Tables in Markdown, one a topic: bounds, trials (values out of bounds marked by "!"), people.
[[nodiscard]] std::string to_text(const DanceReport& report);

/// One JSON document: format "raks-eval-dance", version 1.
[[nodiscard]] std::string to_json(const DanceReport& report);

}  // namespace raks::apps
