#include "apps/reports/eval_dynamics_report.hpp"

#include <cmath>

#include "apps/reports/text_table.hpp"
#include "base/json.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using engine::DynamicsResult;
using engine::Knowledge;
using Reading = std::optional<double>;

// Correlation of loudness and motion to reach on recordings.
constexpr Bound kFollowsKnown{.lowest = 0.45};
constexpr Bound kFollowsLive{.lowest = 0.35};

std::optional<double> in_centimetres(const std::optional<double>& metres) {
    return metres ? Reading(1e2 * *metres) : std::nullopt;
}

// The rows. Ratios are of body speed to that in the full section of music with a breakdown, a stop,
// a drop and an end; "song": a drawn one; "steady": music without a form.
constexpr DynamicsQuantity kDynamicsQuantities[] = {
    {"breakdown_ratio",
     "breakdown / full",
     2,
     Bound{.highest = 0.7},
     [](const DynamicsResult& r) { return Reading(r.ratios.breakdown); }},
    {"silence_ratio",
     "silence from 0.5 s / full",
     2,
     Bound{.highest = 0.25},
     [](const DynamicsResult& r) { return Reading(r.ratios.silence); }},
    {"bar_after_ratio",
     "bar after it / full",
     2,
     Bound{.lowest = 0.7},
     [](const DynamicsResult& r) { return Reading(r.ratios.bar_after); }},
    {"drop_ratio",
     "drop, first 8 s / full",
     2,
     Bound{.lowest = 1.15},
     [](const DynamicsResult& r) { return Reading(r.ratios.drop); }},
    {"end_0_2_ratio",
     "end 0-2 s / full",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.ratios.end_to_2); }},
    {"end_2_5_ratio",
     "end 2-5 s / full",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.ratios.end_to_5); }},
    {"end_5_13_ratio",
     "end 5-13 s / full",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.ratios.end_to_13); }},
    {"song_holds_per_minute",
     "song: holds a minute",
     1,
     Bound{2.0, 8.0},
     [](const DynamicsResult& r) { return Reading(r.phrased.holds_per_minute); }},
    {"song_second_spread",
     "song: 1 s speed p95/p5",
     2,
     Bound{.lowest = 2.2},
     [](const DynamicsResult& r) { return Reading(r.phrased.second_spread); }},
    {"song_body_spread",
     "song: body speed p95/p10",
     2,
     Bound{.lowest = 3.2},
     [](const DynamicsResult& r) { return Reading(r.phrased.body_spread); }},
    {"song_still_hands_percent",
     "song: hands still %",
     1,
     Bound{5.0, 20.0},
     [](const DynamicsResult& r) { return Reading(1e2 * r.phrased.still_hands); }},
    {"song_hand_hits",
     "song: hand acceleration p99/median",
     2,
     Bound{.lowest = 2.9},
     [](const DynamicsResult& r) { return Reading(r.phrased.hand_hits); }},
    {"song_loudness_correlation",
     "song: loudness against motion",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.follows_loudness); }},
    {"bars_to_begin",
     "begins, bars after lock",
     2,
     Bound{.highest = 1.0},
     [](const DynamicsResult& r) { return r.bars_to_begin; },
     Knowledge::live},
    {"first_count_off_ms",
     "first count 1 after the downbeat, ms",
     0,
     Bound{-80.0, 80.0},
     [](const DynamicsResult& r) {
         return r.first_count_off ? Reading(1e3 * *r.first_count_off) : std::nullopt;
     },
     Knowledge::known},
    {"steady_body_speed",
     "steady: body speed m/s",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.steady.body_speed); }},
    {"steady_holds_per_minute",
     "steady: holds a minute",
     1,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.steady.holds_per_minute); }},
    {"steady_second_spread",
     "steady: 1 s speed p95/p5",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.steady.second_spread); }},
    {"steady_body_spread",
     "steady: body speed p95/p10",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.steady.body_spread); }},
    {"steady_hand_speed",
     "steady: hand speed m/s",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.steady.hand_speed); }},
    {"steady_still_hands_percent",
     "steady: hands still %",
     1,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(1e2 * r.steady.still_hands); }},
    {"steady_hand_hits",
     "steady: hand acceleration p99/median",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return Reading(r.steady.hand_hits); }},
    {"steady_nearest_bar_cm",
     "steady: nearest other bar cm",
     1,
     Bound{.lowest = 1.0},
     [](const DynamicsResult& r) { return in_centimetres(r.steady.nearest_bar); }},
    {"steady_distinct_bars",
     "steady: distinct bars of 10 cm",
     2,
     std::nullopt,
     [](const DynamicsResult& r) { return r.steady.distinct_bars; }},
};

// Its value for a dance that is told so much; nothing where it says nothing of such a dance.
Reading value_of(const DynamicsQuantity& quantity,
                 const DynamicsResult& result,
                 Knowledge knowledge) {
    return quantity.only.value_or(knowledge) == knowledge ? quantity.value(result) : std::nullopt;
}

bool has_bound(const DynamicsQuantity& quantity, Knowledge knowledge) {
    return quantity.bound && quantity.only.value_or(knowledge) == knowledge;
}

bool is_outside(const DynamicsQuantity& quantity,
                const DynamicsResult& result,
                Knowledge knowledge) {
    const auto value = value_of(quantity, result, knowledge);
    return has_bound(quantity, knowledge) && !(value && quantity.bound->holds(*value));
}

std::string dynamics_cell(const DynamicsQuantity& quantity,
                          const DynamicsResult& result,
                          Knowledge knowledge) {
    const auto value = value_of(quantity, result, knowledge);
    return (value ? fmt::format("{:.{}f}", *value, quantity.digits) : "-") +
           (is_outside(quantity, result, knowledge) ? "!" : "");
}

Json dynamics_of(const DynamicsResult& result, Knowledge knowledge) {
    Json values = Json::object();
    Json outside = Json::array();
    for (const DynamicsQuantity& quantity : dynamics_quantities()) {
        const auto value = value_of(quantity, result, knowledge);
        values[std::string(quantity.id)] = value ? Json(*value) : Json(nullptr);
        if (is_outside(quantity, result, knowledge)) {
            outside.push_back(std::string(quantity.id));
        }
    }
    return {{"values", values}, {"outside", outside}};
}

// Means over files.
struct FollowedMeans {
    double known = 0.0;
    double live = 0.0;
};
FollowedMeans means_of(std::span<const FollowedFile> files) {
    FollowedMeans means;
    for (const FollowedFile& file : files) {
        means.known += file.known.correlation / static_cast<double>(files.size());
        means.live += file.live.correlation / static_cast<double>(files.size());
    }
    return means;
}

// Share of the bars of parts that come again that are danced as at their first time; nothing where
// no part does. Of several files all bars count alike.
std::optional<double> alike_share(const motion::PartRepeats& repeats) {
    return repeats.bars > 0 ? std::optional(static_cast<double>(repeats.alike) /
                                            static_cast<double>(repeats.bars))
                            : std::nullopt;
}
motion::PartRepeats all_repeats(std::span<const FollowedFile> files) {
    motion::PartRepeats all;
    for (const FollowedFile& file : files) {
        all.bars += file.known.repeats.bars;
        all.alike += file.known.repeats.alike;
    }
    return all;
}

std::string share_cell(const motion::PartRepeats& repeats) {
    const auto share = alike_share(repeats);
    return share ? fmt::format("{:.0f}", 100.0 * *share) : "-";
}

std::string correlation_cell(double value) { return fmt::format("{:+.2f}", value); }

}  // namespace

std::span<const DynamicsQuantity> dynamics_quantities() noexcept { return kDynamicsQuantities; }

Verdict verdict_of(const DynamicsReport& report) {
    Verdict verdict;
    for (const DynamicsQuantity& quantity : dynamics_quantities()) {
        for (const auto& [result, knowledge] :
             {std::pair{&report.known, Knowledge::known}, {&report.live, Knowledge::live}}) {
            if (has_bound(quantity, knowledge)) {
                ++verdict.bounded;
                verdict.outside += is_outside(quantity, *result, knowledge) ? 1U : 0U;
            }
        }
    }
    return verdict;
}

std::string to_text(const DynamicsReport& report) {
    std::vector<Row> rows = {{"quantity", "to reach", "known", "live", "reached"}};
    for (const DynamicsQuantity& quantity : dynamics_quantities()) {
        const bool is_reached = !is_outside(quantity, report.known, Knowledge::known) &&
                                !is_outside(quantity, report.live, Knowledge::live);
        rows.push_back({std::string(quantity.title),
                        bound_cell(quantity.bound, quantity.digits),
                        dynamics_cell(quantity, report.known, Knowledge::known),
                        dynamics_cell(quantity, report.live, Knowledge::live),
                        quantity.bound ? (is_reached ? "yes" : "no") : ""});
    }
    return "Dynamics (body speed by section; a drawn song; steady music; as a file that is known, "
           "and "
           "live)\n\n" +
           text_table(rows) + "\n";
}

Json to_json(const DynamicsReport& report) {
    Json bounds = Json::object();
    for (const DynamicsQuantity& quantity : dynamics_quantities()) {
        if (const auto& bound = quantity.bound) {
            const auto finite = [](double value) {
                return std::isfinite(value) ? Json(value) : Json(nullptr);
            };
            bounds[std::string(quantity.id)] = {finite(bound->lowest), finite(bound->highest)};
        }
    }
    return {{"bounds", bounds},
            {"known", dynamics_of(report.known, Knowledge::known)},
            {"live", dynamics_of(report.live, Knowledge::live)}};
}

std::string to_text(std::span<const FollowedFile> files) {
    const FollowedMeans means = means_of(files);
    std::vector<Row> rows = {
        {"file",
         "loudness spread dB",
         "known",
         "live",
         "bars that come again",
         "as at first %",
         "apart cm"},
        {"to reach, mean", "", bound_cell(kFollowsKnown, 2), bound_cell(kFollowsLive, 2)}};
    rows.back().resize(rows.front().size());
    for (const FollowedFile& file : files) {
        rows.push_back({file.name,
                        fmt::format("{:.1f}", file.known.spread_db),
                        correlation_cell(file.known.correlation),
                        correlation_cell(file.live.correlation),
                        fmt::format("{}", file.known.repeats.bars),
                        share_cell(file.known.repeats),
                        fmt::format("{:.1f}", 1e2 * file.known.repeats.apart)});
    }
    const motion::PartRepeats repeats = all_repeats(files);
    rows.push_back({"mean",
                    "",
                    correlation_cell(means.known) + (kFollowsKnown.holds(means.known) ? "" : "!"),
                    correlation_cell(means.live) + (kFollowsLive.holds(means.live) ? "" : "!"),
                    fmt::format("{}", repeats.bars),
                    share_cell(repeats),
                    ""});
    return "Loudness against motion (correlation, averaged over a second, from 6 s on); of a known "
           "song's\nbars that repeat an earlier one, from 8 s on, the share that is danced within "
           "10 cm of it\n\n" +
           text_table(rows) + "\n";
}

std::string to_json(std::span<const FollowedFile> files) {
    const FollowedMeans means = means_of(files);
    Json document = {{"format", "raks-eval-dance-against"}, {"version", 1}};
    auto& list = document["files"] = Json::array();
    for (const FollowedFile& file : files) {
        list.push_back({{"file", file.name},
                        {"loudness_spread_db", file.known.spread_db},
                        {"known", file.known.correlation},
                        {"live", file.live.correlation},
                        {"repeated_bars", file.known.repeats.bars},
                        {"repeated_bars_alike", file.known.repeats.alike},
                        {"repeated_bars_apart_m", file.known.repeats.apart}});
    }
    document["mean"] = {{"known", means.known}, {"live", means.live}};
    document["bounds"] = {{"known", kFollowsKnown.lowest}, {"live", kFollowsLive.lowest}};
    // A file's name need not be UTF-8; invalid bytes become the replacement character.
    return document.text(2) + "\n";
}

}  // namespace raks::apps
