#include <algorithm>
#include <cmath>

#include "apps/reports/eval_dance_report.hpp"
#include "motion/choreography/figure_measures.hpp"

namespace raks::apps {
namespace {

using engine::TrialKind;
using motion::DanceRole;
using Topic = DanceQuantity::Topic;
using Value = std::optional<double>;
using Limit = std::optional<Bound>;

// Least share of the landings on a ramp that must lie within 80 ms.
constexpr double kLeastOnBeat = 0.95;

// A mean over no landings says nothing.
bool has_landings(const MeasuredDance& dance) { return !dance.result.landing.landings.empty(); }
// The same of contacts of the feet.
bool has_slips(const MeasuredDance& dance) { return !dance.result.measures.contacts.slips.empty(); }
// People's takes have no tempo to follow: what only a dancer has stays empty for them.
bool is_trial(const MeasuredDance& dance) { return dance.kind.has_value(); }

// The value where the dance has one.
Value value_if(bool is_there, double value) { return is_there ? Value(value) : std::nullopt; }
// For quantities that are only reported.
Limit no_bound(TrialKind /*kind*/, const JerkStandard& /*jerk*/) { return std::nullopt; }
// A bound that holds for some kinds of trials only.
Limit bound_if(bool applies, Bound bound) { return applies ? Limit(bound) : std::nullopt; }

// The columns of the report, topic by topic. A row gives: topic, id, title, decimals, how the value
// is read and which bound applies.
constexpr DanceQuantity kQuantities[] = {
    // landings: seconds become milliseconds
    {Topic::landing,
     "landing_mean_ms",
     "mean ms",
     1,
     [](const MeasuredDance& d) { return value_if(has_landings(d), 1e3 * d.result.landing.mean); },
     [](TrialKind kind, const JerkStandard&) {
         return bound_if(kind == TrialKind::steady, {-15.0, 15.0});
     }},
    {Topic::landing,
     "landing_deviation_ms",
     "sd ms",
     1,
     [](const MeasuredDance& d) {
         return value_if(has_landings(d), 1e3 * d.result.landing.deviation);
     },
     [](TrialKind kind, const JerkStandard&) {
         return bound_if(kind == TrialKind::steady, {.highest = 25.0});
     }},
    {Topic::landing,
     "landing_within_80_ms",
     "<= 80 ms",
     3,
     [](const MeasuredDance& d) {
         return value_if(has_landings(d), d.result.landing.within_80_ms);
     },
     [](TrialKind kind, const JerkStandard&) {
         return bound_if(kind == TrialKind::ramp, {.lowest = kLeastOnBeat});
     }},
    {Topic::landing,
     "landings",
     "landings",
     0,
     [](const MeasuredDance& d) {
         return Value(static_cast<double>(d.result.landing.landings.size()));
     },
     no_bound},
    {Topic::landing,
     "landings_missing",
     "missing",
     0,
     [](const MeasuredDance& d) { return Value(static_cast<double>(d.result.landing.missing)); },
     no_bound},
    {Topic::landing,
     "landings_unexpected",
     "unexpected",
     0,
     [](const MeasuredDance& d) { return Value(static_cast<double>(d.result.landing.unexpected)); },
     no_bound},
    {Topic::landing,
     "landings_off_beat_share",
     "off beat",
     3,
     [](const MeasuredDance& d) {
         const auto off = static_cast<double>(d.result.landing.off_beat);
         const double all = off + static_cast<double>(d.result.landing.landings.size());
         return value_if(off > 0.0, off / std::max(all, 1.0));
     },
     no_bound},
    {Topic::landing,
     "danced_share",
     "danced",
     2,
     [](const MeasuredDance& d) { return value_if(is_trial(d), d.result.danced_share); },
     no_bound},
    {Topic::landing,
     "pace",
     "pace",
     2,
     [](const MeasuredDance& d) { return value_if(is_trial(d), d.result.pace); },
     no_bound},
    {Topic::landing,
     "reanchors",
     "re-anchors",
     0,
     [](const MeasuredDance& d) {
         return value_if(is_trial(d), static_cast<double>(d.result.reanchors));
     },
     no_bound},
    // feet: metres become centimetres or millimetres
    {Topic::feet,
     "slip_median_cm",
     "slip cm",
     2,
     [](const MeasuredDance& d) {
         return value_if(has_slips(d), 1e2 * d.result.measures.contacts.slip_median);
     },
     [](TrialKind, const JerkStandard&) { return Limit({.highest = 1.5}); }},
    {Topic::feet,
     "slip_p90_cm",
     "p90 cm",
     2,
     [](const MeasuredDance& d) {
         return value_if(has_slips(d), 1e2 * d.result.measures.contacts.slip_p90);
     },
     [](TrialKind, const JerkStandard&) { return Limit({.highest = 2.7}); }},
    {Topic::feet,
     "contact_share",
     "contact",
     2,
     [](const MeasuredDance& d) { return Value(d.result.measures.contacts.share); },
     no_bound},
    {Topic::feet,
     "contact_toe_speed",
     "toe m/s in contact",
     3,
     [](const MeasuredDance& d) {
         return value_if(has_slips(d), d.result.measures.contacts.toe_speed_mean);
     },
     no_bound},
    {Topic::feet,
     "lowest_sole_mm",
     "lowest mm",
     1,
     [](const MeasuredDance& d) { return Value(1e3 * d.result.lowest_sole); },
     [](TrialKind, const JerkStandard&) { return Limit({.lowest = -5.0}); }},
    {Topic::feet,
     "hand_clearance_cm",
     "hand clear cm",
     1,
     [](const MeasuredDance& d) { return value_if(is_trial(d), 1e2 * d.result.hand_clearance); },
     [](TrialKind, const JerkStandard&) {
         return Limit({.lowest = -1e2 * motion::kMostHandDepth});
     }},
    {Topic::feet,
     "joint_excess_degrees",
     "joint over deg",
     1,
     [](const MeasuredDance& d) { return value_if(is_trial(d), d.result.joint_excess); },
     no_bound},
    // smoothness: bounds from people, see jerk_standard()
    {Topic::smoothness,
     "jerk_rms",
     "jerk rms",
     0,
     [](const MeasuredDance& d) { return Value(d.result.measures.jerk.rms); },
     [](TrialKind, const JerkStandard& jerk) { return jerk.rms; }},
    {Topic::smoothness,
     "jerk_p999",
     "p99.9",
     0,
     [](const MeasuredDance& d) { return Value(d.result.measures.jerk.p999); },
     [](TrialKind, const JerkStandard& jerk) { return jerk.p999; }},
    {Topic::smoothness,
     "jerk_highest",
     "highest",
     0,
     [](const MeasuredDance& d) { return Value(d.result.highest_jerk); },
     [](TrialKind, const JerkStandard& jerk) { return jerk.highest; }},
    {Topic::smoothness,
     "peak_toe_speed",
     "peak toe m/s",
     2,
     [](const MeasuredDance& d) { return Value(d.result.measures.peak_toe_speed); },
     no_bound},
    // quantities of papers, without bounds
    {Topic::others,
     "bas_fact",
     "BAS FACT",
     3,
     [](const MeasuredDance& d) { return Value(d.result.measures.bas_motion); },
     no_bound},
    {Topic::others,
     "bas_bailando",
     "BAS Bailando",
     3,
     [](const MeasuredDance& d) { return Value(d.result.measures.bas_music); },
     no_bound},
    {Topic::others,
     "pfc",
     "PFC",
     2,
     [](const MeasuredDance& d) { return Value(d.result.measures.pfc); },
     no_bound},
    {Topic::others,
     "skating_ratio",
     "skating",
     3,
     [](const MeasuredDance& d) { return Value(d.result.measures.skating_ratio); },
     no_bound},
};

}  // namespace

JerkStandard jerk_standard(const DanceInfo& dance, DanceRole role) noexcept {
    // People's jerk over all takes without faults, their dance parts alone (60 frames a second,
    // low-pass 1-4-6-4-1).
    const double rms = dance.people_jerk_rms[static_cast<std::size_t>(role)];
    const double p999 = dance.people_jerk_p999[static_cast<std::size_t>(role)];
    // A dance that was not captured has no people to compare with: absolute bounds instead.
    if (!(rms > 0.0 && p999 > 0.0)) {
        return {.rms = Bound{60.0, 350.0}, .p999 = Bound{.highest = 2000.0}, .highest = {}};
    }
    // As smooth as people within 20 to 25 %; the highest jerk may be three times what people exceed
    // in a thousandth of the time.
    return {
        .rms = Bound{0.8 * rms, 1.25 * rms}, .p999 = {}, .highest = Bound{.highest = 3.0 * p999}};
}

JerkStandard jerk_standard(const DanceReport& report) noexcept {
    JerkStandard standard = jerk_standard(report.dance, report.role);
    const double rms = report.dance.people_jerk_rms[static_cast<std::size_t>(report.role)];
    if (report.is_of_cells && rms > 0.0) {
        standard.rms = Bound{.highest = 1.1 * rms};
    }
    return standard;
}

std::span<const DanceQuantity> dance_quantities() noexcept { return kQuantities; }

}  // namespace raks::apps
