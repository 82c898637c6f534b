#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "apps/reports/eval_dance_report.hpp"
#include "base/json.hpp"

namespace raks::apps {
namespace {

using engine::TrialKind;

// Names as the document's readers know them.
const char* name_of(TrialKind kind) {
    switch (kind) {
        case TrialKind::steady:
            return "steady";
        case TrialKind::ramp:
            return "ramp";
        case TrialKind::breaks:
            return "breaks";
    }
    return "";
}

// JSON has no infinity: an open end of a bound is null.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// A quantity that a dance does not have is null.
Json optional_number(const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
}

// The figures of these dances together.
Json figures_of(std::span<const MeasuredDance> dances) {
    Json figures = Json::array();
    for (const FigureSummary& figure : figure_summaries(dances)) {
        figures.push_back({{"figure", figure.figure},
                           {"repeats", figure.repeats},
                           {"hips_travel", figure.hips_travel},
                           {"toe_travel", figure.toe_travel},
                           {"peak_toe_speed", figure.peak_toe_speed},
                           {"peak_ball_speed", figure.peak_ball_speed},
                           {"repeat_distance",
                            {{"median", optional_number(figure.distance_median)},
                             {"p10", optional_number(figure.distance_p10)},
                             {"p90", optional_number(figure.distance_p90)}}}});
    }
    return figures;
}

// All quantities of a dance by their id.
Json values_of(const MeasuredDance& dance) {
    Json values = Json::object();
    for (const DanceQuantity& quantity : dance_quantities()) {
        values[std::string(quantity.id)] = optional_number(quantity.value(dance));
    }
    return values;
}

// Mean and deviation of the landings of each figure, foot and count: they show where the overall
// mean comes from.
Json landings_of(const motion::LandingReport& report) {
    std::map<std::tuple<std::string, motion::Side, int>, motion::LandingReport> groups;
    for (const motion::Landing& landing : report.landings) {
        groups[{landing.figure->name, landing.side, landing.count}].landings.push_back(landing);
    }
    Json landings = Json::array();
    for (auto& [key, group] : groups) {
        const auto& [figure, side, count] = key;
        // The statistics of the group alone.
        motion::summarize(group);
        landings.push_back({{"figure", figure},
                            {"foot", side == motion::Side::left ? "left" : "right"},
                            {"count", count},
                            {"landings", group.landings.size()},
                            {"mean_ms", 1e3 * group.mean},
                            {"deviation_ms", 1e3 * group.deviation}});
    }
    return landings;
}

// Measures of each written figure, danced by itself.
Json written_of(const DanceReport& report) {
    Json figures = Json::array();
    for (const engine::DancedWrittenFigure& figure : report.written) {
        const motion::TakeMeasures& is = figure.measures;
        figures.push_back({{"figure", figure.name},
                           {"hip_travel_cm_a_beat", is.hip_travel},
                           {"toe_contacts_a_bar", is.toe_contacts},
                           {"hand_delay_beats", is.hand_delay},
                           {"hand_likeness", is.hand_likeness},
                           {"jerk_rms", is.jerk_rms},
                           {"jerk_p999", is.jerk_p999},
                           {"slip_p90_m", is.slip_p90},
                           {"repeat_distance_m", is.repeat_distance},
                           {"hand_clearance_m", is.hand_clearance},
                           {"hand_near", is.hand_near},
                           {"least_knee_degrees", is.least_knee},
                           {"faults", figure.faults}});
    }
    return figures;
}

// Ids of the quantities that lie outside their bound, or that are missing although they have one.
Json outside_of(const MeasuredDance& dance, const JerkStandard& jerk) {
    Json outside = Json::array();
    for (const DanceQuantity& quantity : dance_quantities()) {
        const auto bound = quantity.bound(*dance.kind, jerk);
        const auto value = quantity.value(dance);
        // A missing value cannot lie within its bound.
        if (bound && !(value && bound->holds(*value))) {
            outside.push_back(std::string(quantity.id));
        }
    }
    return outside;
}

// The bounds that apply to trials of this kind.
Json bounds_of(TrialKind kind, const JerkStandard& jerk) {
    Json bounds = Json::object();
    for (const DanceQuantity& quantity : dance_quantities()) {
        if (const auto bound = quantity.bound(kind, jerk)) {
            bounds[std::string(quantity.id)] = {finite(bound->lowest), finite(bound->highest)};
        }
    }
    return bounds;
}

}  // namespace

std::string to_json(const DanceReport& report) {
    const JerkStandard jerk = jerk_standard(report);
    Json document = {{"format", "raks-eval-dance"},
                     {"version", 1},
                     {"dance", report.dance.name},
                     {"role", motion::kRoleNames[static_cast<std::size_t>(report.role)]},
                     {"generator", report.generator},
                     {"seed", report.seed}};
    // Bounds once a kind of trial, not with every trial.
    auto& bounds = document["bounds"] = Json::object();
    for (const TrialKind kind : {TrialKind::steady, TrialKind::ramp, TrialKind::breaks}) {
        bounds[name_of(kind)] = bounds_of(kind, jerk);
    }
    auto& trials = document["trials"] = Json::array();
    for (const MeasuredDance& trial : report.trials) {
        trials.push_back({{"name", trial.name},
                          {"kind", name_of(*trial.kind)},
                          {"values", values_of(trial)},
                          {"outside", outside_of(trial, jerk)},
                          {"landings", landings_of(trial.result.landing)},
                          {"figures", figures_of(std::span(&trial, 1))}});
        if (const auto& couple = trial.result.couple) {
            trials.back()["couple"] = {{"hands_p90", couple->hands_p90},
                                       {"facing_p90", couple->facing_p90},
                                       {"closest", couple->closest},
                                       {"closest_in", couple->closest_in},
                                       {"overlapping", couple->overlapping},
                                       {"held", couple->held},
                                       {"palms_median", couple->palms_median},
                                       {"palms_p90", couple->palms_p90},
                                       {"held_height", couple->held_height}};
        }
    }
    // Over all trials together.
    document["figures"] = figures_of(report.trials);
    if (report.dynamics) {
        document["dynamics"] = to_json(*report.dynamics);
    }
    if (!report.written.empty()) {
        document["written_figures"] = written_of(report);
    }
    if (!report.people.empty()) {
        auto& takes = document["people"]["takes"] = Json::array();
        for (const MeasuredDance& take : report.people) {
            takes.push_back({{"name", take.name}, {"values", values_of(take)}});
        }
        document["people"]["all"] = values_of(all_people(report.people));
        document["people"]["figures"] = figures_of(report.people);
        auto& paces = document["people"]["jerk_by_pace"] = Json::array();
        const auto jerks = jerk_by_pace(report.people);
        for (std::size_t p = 0; p < jerks.size(); ++p) {
            paces.push_back({{"pace", motion::kJudgedPaces[p]}, {"rms", jerks[p]}});
        }
    }
    // A take's name need not be UTF-8; invalid bytes become the replacement character.
    return document.text(2) + "\n";
}

}  // namespace raks::apps
