#include "apps/reports/eval_report.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "apps/reports/reliability_table.hpp"
#include "apps/reports/text_table.hpp"
#include "base/json.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using audio::BeatMeasure;

// The measures that several trackers are compared by, one table each.
constexpr std::array kByClass = {BeatMeasure::f,
                                 BeatMeasure::cml_total,
                                 BeatMeasure::aml_total,
                                 BeatMeasure::prediction_f,
                                 BeatMeasure::downbeat_f};

// Shares as percentages, other units as they are; "-" where there is no value.
std::string cell(BeatMeasure measure, const std::optional<double>& value) {
    if (!value) {
        return "-";
    }
    const bool is_share = audio::info_of(measure).unit == audio::BeatMeasureInfo::Unit::share;
    return fmt::format("{:.1f}", is_share ? 100.0 * *value : *value);
}

// The heads of the columns, in the order of append_scores().
void append_measure_names(Row& row) {
    for (std::size_t i = 0; i < audio::kBeatMeasures; ++i) {
        row.emplace_back(audio::info_of(static_cast<BeatMeasure>(i)).name);
    }
    row.emplace_back("never locked");
}

void append_scores(Row& row, const audio::BeatSummary& summary) {
    for (std::size_t i = 0; i < audio::kBeatMeasures; ++i) {
        const auto measure = static_cast<BeatMeasure>(i);
        row.push_back(cell(measure, summary.scores[measure]));
    }
    row.push_back(std::to_string(summary.never_locked));
}

// Rows: classes; columns: measures.
std::string one_tracker_by_class(const BeatReport& report) {
    std::vector<Row> rows = {{report.trackers.front().name, "n"}};
    append_measure_names(rows.front());
    for (const BeatGroup& group : groups_of(report)) {
        Row& row = rows.emplace_back(Row{group.name, std::to_string(group.excerpts.size())});
        append_scores(row, summary_of(report.trackers.front(), group));
    }
    return text_table(rows);
}

// Rows: trackers; columns: measures over all excerpts.
std::string trackers_over_all(const BeatReport& report) {
    const BeatGroup all = groups_of(report).front();
    std::vector<Row> rows = {{fmt::format("{} excerpts", report.excerpts.size())}};
    append_measure_names(rows.front());
    for (const ScoredTracker& tracker : report.trackers) {
        append_scores(rows.emplace_back(Row{tracker.name}), summary_of(tracker, all));
    }
    return text_table(rows);
}

// Rows: trackers; columns: classes, for one measure. Empty where no tracker has the measure.
std::string trackers_by_class(const BeatReport& report, BeatMeasure measure) {
    const std::vector<BeatGroup> groups = groups_of(report);
    std::vector<Row> rows = {{std::string(audio::info_of(measure).name)}};
    for (const BeatGroup& group : groups) {
        rows.front().push_back(group.name);
    }
    for (const ScoredTracker& tracker : report.trackers) {
        Row row = {tracker.name};
        for (const BeatGroup& group : groups) {
            row.push_back(cell(measure, summary_of(tracker, group).scores[measure]));
        }
        // A tracker without bars or predictions is left out of the tables of those.
        if (std::any_of(row.begin() + 1, row.end(), [](const auto& c) { return c != "-"; })) {
            rows.push_back(std::move(row));
        }
    }
    return rows.size() > 1 ? "\n" + text_table(rows) : std::string();
}

// Rows: excerpts; columns: measures. A group of one excerpt gives its own scores.
std::string by_excerpt(const BeatReport& report, const ScoredTracker& tracker) {
    std::vector<Row> rows = {{tracker.name, "class"}};
    append_measure_names(rows.front());
    for (std::size_t i = 0; i < report.excerpts.size(); ++i) {
        Row& row = rows.emplace_back(Row{report.excerpts[i].name, report.excerpts[i].category});
        append_scores(row, summary_of(tracker, {report.excerpts[i].name, {i}}));
    }
    return "\n" + text_table(rows);
}

// Claims of all excerpts in one row.
std::vector<audio::Claim> all_claims(const ScoredTracker& tracker,
                                     std::vector<audio::Claim> audio::BeatClaims::*kind) {
    std::vector<audio::Claim> all;
    for (const audio::BeatClaims& claims : tracker.claims) {
        all.insert(all.end(), (claims.*kind).begin(), (claims.*kind).end());
    }
    return all;
}

// Empty where the tracker gives no confidence.
std::string tracker_reliability(const ScoredTracker& tracker) {
    if (tracker.claims.empty()) {
        return {};
    }
    return "\n" +
           reliability_table(tracker.name + ", confidence",
                             {{"beats", all_claims(tracker, &audio::BeatClaims::beats)},
                              {"bar positions", all_claims(tracker, &audio::BeatClaims::bars)}});
}

}  // namespace

// "all" comes first; classes follow in the order of their first excerpt.
std::vector<BeatGroup> groups_of(const BeatReport& report) {
    std::vector<BeatGroup> groups = {{"all", {}}};
    for (std::size_t i = 0; i < report.excerpts.size(); ++i) {
        const std::string& category = report.excerpts[i].category;
        groups.front().excerpts.push_back(i);
        auto group = std::find_if(groups.begin() + 1, groups.end(), [&](const BeatGroup& known) {
            return known.name == category;
        });
        if (group == groups.end()) {
            group = groups.insert(groups.end(), {category, {}});
        }
        group->excerpts.push_back(i);
    }
    return groups;
}

// The summary decides how missing values count.
audio::BeatSummary summary_of(const ScoredTracker& tracker, const BeatGroup& group) {
    std::vector<audio::BeatScores> scores;
    for (const std::size_t i : group.excerpts) {
        scores.push_back(tracker.scores[i]);
    }
    return audio::summarize(scores);
}

std::string to_text(const BeatReport& report, Detail detail) {
    std::string text;
    if (report.trackers.size() == 1) {
        text = one_tracker_by_class(report);
    } else {
        text = trackers_over_all(report);
        for (const BeatMeasure measure : kByClass) {
            text += trackers_by_class(report, measure);
        }
    }
    if (detail == Detail::by_excerpt) {
        for (const ScoredTracker& tracker : report.trackers) {
            text += by_excerpt(report, tracker);
        }
    }
    for (const ScoredTracker& tracker : report.trackers) {
        text += tracker_reliability(tracker);
    }
    return text;
}

namespace {

// Scores by the short names of the measures; null where a tracker has no value.
Json scores_of(const audio::BeatScores& scores) {
    Json document = Json::object();
    for (std::size_t i = 0; i < audio::kBeatMeasures; ++i) {
        const auto measure = static_cast<audio::BeatMeasure>(i);
        const std::string name(audio::info_of(measure).name);
        document[name] = scores[measure] ? Json(*scores[measure]) : Json(nullptr);
    }
    return document;
}

// One tracker: means by class, then every excerpt.
Json tracker_of(const BeatReport& report, const ScoredTracker& tracker) {
    Json groups = Json::array();
    for (const BeatGroup& group : groups_of(report)) {
        const audio::BeatSummary summary = summary_of(tracker, group);
        groups.push_back({{"class", group.name},
                          {"excerpts", summary.excerpts},
                          {"never_locked", summary.never_locked},
                          {"scores", scores_of(summary.scores)}});
    }
    Json excerpts = Json::array();
    for (std::size_t i = 0; i < report.excerpts.size(); ++i) {
        excerpts.push_back({{"name", report.excerpts[i].name},
                            {"class", report.excerpts[i].category},
                            {"scores", scores_of(tracker.scores[i])}});
    }
    Json document = {{"name", tracker.name}, {"classes", groups}, {"excerpts", excerpts}};
    if (!tracker.claims.empty()) {
        document["reliability"] = {
            {"beats", reliability_json(all_claims(tracker, &audio::BeatClaims::beats))},
            {"bars", reliability_json(all_claims(tracker, &audio::BeatClaims::bars))}};
    }
    return document;
}

}  // namespace

std::string to_json(const BeatReport& report) {
    Json document = {{"format", "raks-eval-beats"}, {"version", 1}, {"corpus", report.corpus}};
    auto& trackers = document["trackers"] = Json::array();
    for (const ScoredTracker& tracker : report.trackers) {
        trackers.push_back(tracker_of(report, tracker));
    }
    // A file's name need not be UTF-8; invalid bytes become the replacement character.
    return document.text(2) + "\n";
}

}  // namespace raks::apps
