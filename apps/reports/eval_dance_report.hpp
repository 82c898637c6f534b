#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/trials/dance_trial.hpp"
#include "engine/trials/figure_alone.hpp"
#include "motion/evaluate/captured_dance.hpp"

namespace raks::apps {

/// A dance that was measured: of the dancer, or of people.
struct MeasuredDance {
    std::string name;
    std::optional<engine::TrialKind> kind;  ///< none: people
    engine::TrialResult result;
    motion::JerkByPace jerk_by_pace{};  ///< of people
};

/// [lowest, highest] that a quantity may have.
struct Bound {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool holds(double value) const noexcept {
        return value >= lowest && value <= highest;
    }
};

/// How smooth a dance must be, m/s^3: beside the people that it was learnt from, or, written, by
/// absolute values.
struct JerkStandard {
    std::optional<Bound> rms;
    std::optional<Bound> p999;
    std::optional<Bound> highest;
};
[[nodiscard]] JerkStandard jerk_standard(const DanceInfo& dance, motion::DanceRole role) noexcept;

struct DanceReport {
    DanceInfo dance;
    motion::DanceRole role = motion::DanceRole::lead;
    std::string generator = "trajectories";
    std::int64_t seed = 1;
    std::vector<MeasuredDance> trials;
    std::vector<MeasuredDance> people;                 ///< by take, empty without clips
    std::vector<engine::DancedWrittenFigure> written;  ///< each by itself; empty: captured
};

/// Captured takes as rows of the report. What only a dancer has (pace, re-anchors) stays empty.
[[nodiscard]] std::vector<MeasuredDance> as_rows(std::span<const motion::CapturedDance> takes);
/// Of all takes together, had they danced at motion::kJudgedPaces. Jerk rms, by pace.
[[nodiscard]] std::array<double, motion::kJudgedPaces.size()> jerk_by_pace(
    std::span<const MeasuredDance> takes);
/// All takes as one, samples pooled. At least one.
[[nodiscard]] MeasuredDance all_people(std::span<const MeasuredDance> takes);

/// One column of the report.
struct DanceQuantity {
    enum class Topic : std::uint8_t { landing, feet, smoothness, others };
    Topic topic;
    std::string_view id;     ///< in JSON: "landing_mean_ms"
    std::string_view title;  ///< of the column: "mean ms"
    int digits;
    /// Nothing where the dance has none.
    std::optional<double> (*value)(const MeasuredDance& dance);
    /// Of a trial; nothing: only reported.
    std::optional<Bound> (*bound)(engine::TrialKind kind, const JerkStandard& jerk);
};
[[nodiscard]] std::span<const DanceQuantity> dance_quantities() noexcept;

/// What a couple must keep to.
inline constexpr Bound kCoupleHands = {.highest = 0.25};  ///< metres, p90 in the basic
/// Metres: legs that step between one another touch; trunks that pass do not.
inline constexpr Bound kCoupleClosest = {.lowest = -0.05};

/// Metres between two repeats of a written figure; people's salsa: 11.6.
inline constexpr Bound kRepeatDistance = {0.06, 0.14};

/// One figure over several dances.
struct FigureSummary {
    std::string figure;
    std::size_t repeats = 0;
    double hips_travel = 0.0;      ///< median; metres
    double toe_travel = 0.0;       ///< median; metres
    double peak_toe_speed = 0.0;   ///< median; m/s
    double peak_ball_speed = 0.0;  ///< median; m/s
    /// Between repeats, metres: of people any two, of trials two of one trial (the seed is the same
    /// in all). Nothing with less than two.
    std::optional<double> distance_median, distance_p10, distance_p90;
};
[[nodiscard]] std::vector<FigureSummary> figure_summaries(std::span<const MeasuredDance> dances);

/// Tables in Markdown, a topic each: bounds, trials (what is out of bounds marked by "!"), people.
[[nodiscard]] std::string to_text(const DanceReport& report);

/// One document: format "raks-eval-dance", version 1.
[[nodiscard]] std::string to_json(const DanceReport& report);

}  // namespace raks::apps
