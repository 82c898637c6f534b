#pragma once

#include <string>
#include <vector>

#include "audio/evaluate/beat_scores.hpp"

/// How `raks eval beats` shows scores.
namespace raks::apps {

/// One excerpt of the corpus.
struct ScoredExcerpt {
    std::string name;
    std::string category;
};

/// One row of the tables.
struct ScoredTracker {
    std::string name;
    std::vector<audio::BeatScores> scores;  ///< by excerpt
};

struct BeatReport {
    std::string corpus;  ///< the folder as given
    std::vector<ScoredExcerpt> excerpts;
    std::vector<ScoredTracker> trackers;  ///< at least one
};

/// A class of excerpts, or all of them.
struct BeatGroup {
    std::string name;                   ///< "all" or the class
    std::vector<std::size_t> excerpts;  ///< indices
};
/// "all", then the classes in the order in which they come.
[[nodiscard]] std::vector<BeatGroup> groups_of(const BeatReport& report);
[[nodiscard]] audio::BeatSummary summary_of(const ScoredTracker& tracker, const BeatGroup& group);

enum class Detail { by_class, by_excerpt };

/// Tables in Markdown, per cent, seconds and milliseconds: one tracker by class; several over all
/// excerpts, then F, CMLt, AMLt, pred35 and downF by class; by excerpt too where asked.
[[nodiscard]] std::string to_text(const BeatReport& report, Detail detail);

/// One document: format "raks-eval-beats", version 1; shares in [0, 1], null where there is no
/// value. By class and by excerpt.
[[nodiscard]] std::string to_json(const BeatReport& report);

}  // namespace raks::apps
