#include "apps/reports/eval_report.hpp"

#include <nlohmann/json.hpp>

namespace raks::apps {
namespace {

using Json = nlohmann::ordered_json;

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
    return {{"name", tracker.name}, {"classes", groups}, {"excerpts", excerpts}};
}

}  // namespace

std::string to_json(const BeatReport& report) {
    Json document = {{"format", "raks-eval-beats"}, {"version", 1}, {"corpus", report.corpus}};
    auto& trackers = document["trackers"] = Json::array();
    for (const ScoredTracker& tracker : report.trackers) {
        trackers.push_back(tracker_of(report, tracker));
    }
    // A file's name need not be UTF-8; invalid bytes become the replacement character.
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace raks::apps
