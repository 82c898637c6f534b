#pragma once

#include <string>
#include <vector>

#include "audio/evaluate/beat_scores.hpp"

/// Text and JSON of the scores of `raks eval beats`.
namespace raks::apps {

/// One excerpt of the corpus.
struct ScoredExcerpt {
    std::string name;      ///< its file's name
    std::string category;  ///< class within the corpus, such as a style
};

/// One tracker with its scores.
struct ScoredTracker {
    std::string name;                       ///< of the tracker or method
    std::vector<audio::BeatScores> scores;  ///< one an excerpt, in the report's order
    /// What it said with which confidence, one an excerpt; empty: it gives none.
    std::vector<audio::BeatClaims> claims;
};

/// All scores of an evaluation.
struct BeatReport {
    std::string corpus;                   ///< the folder as given
    std::vector<ScoredExcerpt> excerpts;  ///< in the order of the scores
    std::vector<ScoredTracker> trackers;  ///< at least one
};

/// Excerpts whose scores are summarized together: a class, or all.
struct BeatGroup {
    std::string name;                   ///< "all" or the class
    std::vector<std::size_t> excerpts;  ///< indices into the report's excerpts
};
/// The group "all", then one a class in the order in which they first occur.
[[nodiscard]] std::vector<BeatGroup> groups_of(const BeatReport& report);
/// Mean scores of a tracker over a group.
[[nodiscard]] audio::BeatSummary summary_of(const ScoredTracker& tracker, const BeatGroup& group);

/// How far the text goes into detail.
enum class Detail { by_class, by_excerpt };

/// Tables in Markdown, in per cent, seconds and milliseconds. One tracker: its scores by class.
/// Several: over all excerpts, then F, CMLt, AMLt, pred35 and downF by class. By excerpt as well
/// where asked. Last, of trackers with confidences, how often claims of each confidence are right.
[[nodiscard]] std::string to_text(const BeatReport& report, Detail detail);

/// One JSON document: format "raks-eval-beats", version 1; shares in [0, 1], null where there is no
/// value. By class and by excerpt.
[[nodiscard]] std::string to_json(const BeatReport& report);

}  // namespace raks::apps
