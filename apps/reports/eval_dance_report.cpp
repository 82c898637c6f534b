#include "apps/reports/eval_dance_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/reports/text_table.hpp"
#include "base/statistics.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using engine::TrialKind;
using Topic = DanceQuantity::Topic;

// Heading of a topic's table; it says how the quantities are to be read.
struct TopicTitle {
    Topic topic;
    std::string_view title;
};
constexpr std::array<TopicTitle, 4> kTopics = {
    {{Topic::landing,
      "Landing against the beats heard, less the learnt offsets (mean and sd: steady music; within "
      "80 ms: ramps)"},
     {Topic::feet, "Feet (contact: toe under 0.25 m/s and 5 cm)"},
     {Topic::smoothness, "Smoothness (m/s^3 at 60 a second, 1-4-6-4-1; by pace)"},
     {Topic::others, "What papers report (no bounds: people who dance as couples score low)"}}};

// A number with the quantity's decimals.
std::string number(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

// A value as text; "!" marks one that lies outside its bound.
std::string value_cell(const DanceQuantity& quantity,
                       const MeasuredDance& dance,
                       const JerkStandard& jerk) {
    const auto value = quantity.value(dance);
    if (!value) {
        return "-";
    }
    const auto bound = dance.kind ? quantity.bound(*dance.kind, jerk) : std::nullopt;
    return number(*value, quantity.digits) + (bound && !bound->holds(*value) ? "!" : "");
}

// The bound of the first kind of trial that has one: the table has one row of bounds for all kinds.
std::optional<Bound> any_bound(const DanceQuantity& quantity, const JerkStandard& jerk) {
    for (const TrialKind kind : {TrialKind::steady, TrialKind::ramp, TrialKind::breaks}) {
        if (const auto bound = quantity.bound(kind, jerk)) {
            return bound;
        }
    }
    return std::nullopt;
}

// One table: dances as rows, quantities as columns, bounds in the second row.
std::string table_of(std::span<const MeasuredDance* const> dances,
                     const JerkStandard& jerk,
                     const TopicTitle& topic) {
    std::vector<Row> rows = {{"trial"}, {"bound"}};
    for (const MeasuredDance* dance : dances) {
        rows.push_back({dance->name});
    }
    for (const DanceQuantity& quantity : dance_quantities()) {
        if (quantity.topic != topic.topic) {
            continue;
        }
        rows[0].emplace_back(quantity.title);
        rows[1].push_back(bound_cell(any_bound(quantity, jerk), quantity.digits));
        for (std::size_t i = 0; i < dances.size(); ++i) {
            rows[i + 2].push_back(value_cell(quantity, *dances[i], jerk));
        }
    }
    return fmt::format("{}\n\n{}\n", topic.title, text_table(rows));
}

// Median of one member over all repeats.
double median_of(const std::vector<motion::Amplitude>& amplitudes,
                 double motion::Amplitude::*member) {
    std::vector<double> values;
    values.reserve(amplitudes.size());
    for (const motion::Amplitude& amplitude : amplitudes) {
        values.push_back(amplitude.*member);
    }
    return percentile(std::move(values), 0.5);
}

// Distances between repeats of one figure. Of people between all pairs; of trials within each trial
// only, since the seed is the same in all trials and so are the draws.
std::vector<double> distances_of(const motion::FigureMeasures& all,
                                 // People's takes come without a kind.
                                 std::span<const MeasuredDance> dances) {
    if (dances.empty() || !dances.front().kind) {
        return motion::repeat_distances(all.shapes);
    }
    std::vector<double> distances;
    for (const MeasuredDance& dance : dances) {
        for (const motion::FigureMeasures& figure : dance.result.measures.figures) {
            if (figure.figure == all.figure) {
                const auto within = motion::repeat_distances(figure.shapes);
                distances.insert(distances.end(), within.begin(), within.end());
            }
        }
    }
    return distances;
}

// One row a figure of these dances; distances in centimetres.
void append_figures(std::vector<Row>& rows,
                    const char* who,
                    std::span<const MeasuredDance> dances) {
    for (const FigureSummary& figure : figure_summaries(dances)) {
        const auto centimetres = [](const std::optional<double>& value) {
            return value ? number(1e2 * *value, 1) : "-";
        };
        rows.push_back({fmt::format("{}: {}", who, figure.figure),
                        std::to_string(figure.repeats),
                        number(figure.hips_travel, 2),
                        number(figure.toe_travel, 2),
                        number(figure.peak_toe_speed, 2),
                        number(figure.peak_ball_speed, 2),
                        centimetres(figure.distance_median),
                        centimetres(figure.distance_p10),
                        centimetres(figure.distance_p90)});
    }
}

std::string figures_table(const DanceReport& report) {
    std::vector<Row> rows = {{"figure",
                              "repeats",
                              "hips travel m",
                              "toe travel m",
                              "peak toe m/s",
                              "peak ball m/s",
                              "between repeats cm",
                              "p10",
                              "p90"}};
    append_figures(rows, "Raks", report.trials);
    append_figures(rows, "people", report.people);
    return "Figures (medians; speed by pace)\n\n" + text_table(rows) + "\n";
}

// True when two repeats differ enough and not too much. The bound is absolute, from people's salsa.
bool is_varied(const engine::DancedWrittenFigure& figure) {
    return kRepeatDistance.holds(figure.measures.repeat_distance);
}

// The table of written figures, with their faults below; empty where the dance was captured.
std::string written_table(const DanceReport& report) {
    if (report.written.empty()) {
        return "";
    }
    std::vector<Row> rows = {{"figure",
                              "hips cm a beat",
                              "contacts a bar",
                              "hands behind head, beats",
                              "alike",
                              "jerk rms",
                              "p99.9",
                              "slip p90 cm",
                              "repeats apart cm",
                              "hand clear cm",
                              "least knee deg"}};
    std::string faults;
    for (const engine::DancedWrittenFigure& figure : report.written) {
        const motion::TakeMeasures& is = figure.measures;
        rows.push_back({figure.name + (figure.faults.empty() ? "" : " !"),
                        number(is.hip_travel, 1),
                        number(is.toe_contacts, 1),
                        number(is.hand_delay, 2),
                        number(is.hand_likeness, 2),
                        number(is.jerk_rms, 0),
                        number(is.jerk_p999, 0),
                        number(1e2 * is.slip_p90, 1),
                        number(1e2 * is.repeat_distance, 1) + (is_varied(figure) ? "" : "!"),
                        number(1e2 * is.hand_clearance, 1),
                        number(is.least_knee, 0)});
        for (const std::string& fault : figure.faults) {
            faults += fault + "\n";
        }
    }
    return "Each figure by itself on a perfect beat, against what its file expects\n\n" +
           text_table(rows) + "\n" + faults + (faults.empty() ? "" : "\n");
}

// People's jerk at other paces. The bounds hold at people's own tempo; the low-pass filter takes
// more of a faster dance, so that the same bound is easier to keep there.
std::string paces_table(const DanceReport& report) {
    const auto jerks = jerk_by_pace(report.people);
    // The column of people's own tempo: shares are relative to it.
    const auto own = std::find(motion::kJudgedPaces.begin(), motion::kJudgedPaces.end(), 1.0) -
                     motion::kJudgedPaces.begin();
    std::vector<Row> rows = {{"pace"}, {"jerk rms"}, {"share"}};
    for (std::size_t p = 0; p < jerks.size(); ++p) {
        rows[0].push_back(number(motion::kJudgedPaces[p], 2));
        rows[1].push_back(number(jerks[p], 0));
        rows[2].push_back(number(jerks[p] / jerks[static_cast<std::size_t>(own)], 2));
    }
    return "People's jerk, had they danced so fast (the filter takes more of a faster dance)\n\n" +
           text_table(rows) + "\n";
}

// The table of a couple's measures; empty where nobody danced as a couple.
std::string couple_table(const DanceReport& report) {
    std::vector<Row> rows = {{"trial",
                              "hands p90 cm",
                              "past one another p90 deg",
                              "closest cm",
                              "in",
                              "overlap %",
                              "held %",
                              "palms p50 cm",
                              "palms p90 cm",
                              "held height cm"},
                             {"bound",
                              bound_cell(Bound{.highest = 1e2 * kCoupleHands.highest}, 1),
                              "",
                              bound_cell(Bound{.lowest = 1e2 * kCoupleClosest.lowest}, 1),
                              "",
                              "",
                              "",
                              bound_cell(Bound{.highest = 1e2 * kPalmsMedian.highest}, 1),
                              bound_cell(Bound{.highest = 1e2 * kPalmsP90.highest}, 1),
                              ""}};
    for (const MeasuredDance& trial : report.trials) {
        if (const auto& couple = trial.result.couple) {
            rows.push_back({trial.name,
                            number(1e2 * couple->hands_p90, 1) +
                                (kCoupleHands.holds(couple->hands_p90) ? "" : "!"),
                            number(180.0 / M_PI * couple->facing_p90, 0),
                            number(1e2 * couple->closest, 1) +
                                (kCoupleClosest.holds(couple->closest) ? "" : "!"),
                            couple->closest_in,
                            number(1e2 * couple->overlapping, 2),
                            number(1e2 * couple->held, 0),
                            number(1e2 * couple->palms_median, 1) +
                                (kPalmsMedian.holds(couple->palms_median) ? "" : "!"),
                            number(1e2 * couple->palms_p90, 1) +
                                (kPalmsP90.holds(couple->palms_p90) ? "" : "!"),
                            number(1e2 * couple->held_height, 1)});
        }
    }
    // Two rows are the heads and the bounds.
    return rows.size() > 2
               ? "The couple (hands and facing in the basic)\n\n" + text_table(rows) + "\n"
               : "";
}

// One line: how many of the bounded values lie within their bounds. A missing value counts as
// outside.
std::string verdict(const DanceReport& report) {
    const JerkStandard jerk = jerk_standard(report);
    std::size_t bounded = 0;
    std::size_t outside = 0;
    for (const MeasuredDance& trial : report.trials) {
        for (const DanceQuantity& quantity : dance_quantities()) {
            const auto bound = quantity.bound(*trial.kind, jerk);
            const auto value = quantity.value(trial);
            if (bound) {
                ++bounded;
                outside += value && bound->holds(*value) ? 0U : 1U;
            }
        }
    }
    for (const engine::DancedWrittenFigure& figure : report.written) {
        // Two bounds a figure: its file's expectations, and the distance of two repeats.
        bounded += 2;
        outside += (figure.faults.empty() ? 0U : 1U) + (is_varied(figure) ? 0U : 1U);
    }
    if (report.dynamics) {
        const Verdict dynamics = verdict_of(*report.dynamics);
        bounded += dynamics.bounded;
        outside += dynamics.outside;
    }
    return fmt::format(
        "{} of {} values that have a bound are within it\n", bounded - outside, bounded);
}

}  // namespace

// The quantities that takes of people have lie where a trial's lie.
std::vector<MeasuredDance> as_rows(std::span<const motion::CapturedDance> takes) {
    std::vector<MeasuredDance> rows;
    for (const motion::CapturedDance& take : takes) {
        MeasuredDance& row = rows.emplace_back(MeasuredDance{take.take, std::nullopt, {}});
        row.result.landing = take.landing;
        row.result.measures = take.measures;
        row.result.highest_jerk = take.measures.jerk.highest;
        row.result.lowest_sole = take.measures.contacts.lowest_toe;
        row.jerk_by_pace = take.jerk_by_pace;
    }
    return rows;
}

std::array<double, motion::kJudgedPaces.size()> jerk_by_pace(std::span<const MeasuredDance> takes) {
    motion::JerkByPace all{};
    // Pooled by sums and counts, so that long takes count for more.
    std::array<double, motion::kJudgedPaces.size()> rms{};
    for (std::size_t p = 0; p < rms.size(); ++p) {
        for (const MeasuredDance& take : takes) {
            all[p].sum += take.jerk_by_pace[p].sum;
            all[p].count += take.jerk_by_pace[p].count;
        }
        rms[p] = all[p].rms();
    }
    return rms;
}

// Landings are pooled one by one and summarized again: means of means would weigh short takes too
// much.
MeasuredDance all_people(std::span<const MeasuredDance> takes) {
    MeasuredDance all{"people", std::nullopt, {}};
    std::vector<motion::DanceMeasures> measures;
    motion::LandingReport& landing = all.result.landing;
    for (const MeasuredDance& take : takes) {
        measures.push_back(take.result.measures);
        const motion::LandingReport& one = take.result.landing;
        landing.landings.insert(landing.landings.end(), one.landings.begin(), one.landings.end());
        landing.missing += one.missing;
        landing.unexpected += one.unexpected;
    }
    motion::summarize(landing);
    all.result.measures = motion::pooled(measures);
    all.result.highest_jerk = all.result.measures.jerk.highest;
    all.result.lowest_sole = all.result.measures.contacts.lowest_toe;
    return all;
}

// Only the figures' measures are pooled here; the rest of the measures is not needed.
std::vector<FigureSummary> figure_summaries(std::span<const MeasuredDance> dances) {
    std::vector<motion::DanceMeasures> measures;
    for (const MeasuredDance& dance : dances) {
        measures.push_back({});
        measures.back().figures = dance.result.measures.figures;
    }
    std::vector<FigureSummary> summaries;
    for (const motion::FigureMeasures& figure : motion::pooled(measures).figures) {
        FigureSummary& summary = summaries.emplace_back();
        summary.figure = figure.figure;
        summary.repeats = figure.amplitudes.size();
        summary.hips_travel = median_of(figure.amplitudes, &motion::Amplitude::hips_travel);
        summary.toe_travel = median_of(figure.amplitudes, &motion::Amplitude::toe_travel);
        summary.peak_toe_speed = median_of(figure.amplitudes, &motion::Amplitude::peak_toe_speed);
        summary.peak_ball_speed = median_of(figure.amplitudes, &motion::Amplitude::peak_ball_speed);
        const std::vector<double> distances = distances_of(figure, dances);
        if (!distances.empty()) {
            summary.distance_median = percentile(distances, 0.5);
            summary.distance_p10 = percentile(distances, 0.1);
            summary.distance_p90 = percentile(distances, 0.9);
        }
    }
    return summaries;
}

std::string to_text(const DanceReport& report) {
    std::string text = fmt::format("{}, {}, {}, seed {}\n\n",
                                   report.dance.name,
                                   motion::kRoleNames[static_cast<std::size_t>(report.role)],
                                   report.generator,
                                   report.seed);
    std::vector<const MeasuredDance*> rows;
    for (const MeasuredDance& trial : report.trials) {
        rows.push_back(&trial);
    }
    std::optional<MeasuredDance> people;
    if (!report.people.empty()) {
        rows.push_back(&people.emplace(all_people(report.people)));
    }
    // Without trials and people the tables would be empty: only the dynamics were asked for.
    for (const TopicTitle& topic : kTopics) {
        text += rows.empty() ? "" : table_of(rows, jerk_standard(report), topic);
    }
    if (people) {
        text += paces_table(report);
    }
    if (!rows.empty()) {
        text += figures_table(report);
    }
    if (report.dynamics) {
        text += to_text(*report.dynamics);
    }
    return text + written_table(report) + couple_table(report) + verdict(report);
}

}  // namespace raks::apps
