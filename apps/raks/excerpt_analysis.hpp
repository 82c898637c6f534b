#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/evaluate/beat_corpus.hpp"

/// What `raks eval beats` hears: our own trackers over the excerpts of a corpus.
namespace raks::apps {

/// What one tracker said about one excerpt, times to the microsecond as `raks analyze --json` tells
/// them.
struct ExcerptBeats {
    audio::BeatEstimate estimate;
    std::string warning;  ///< what is wrong with a file that still plays; empty when nothing is
};

/// One file from its start to its end: beats as announced and as predicted, without look-ahead (but
/// paper-whole: that announces all at the end and predicts none). Errors: as MusicSource::open.
[[nodiscard]] Expected<ExcerptBeats> analyze_excerpt(
    const Path& audio, FileBeatMethod method, std::shared_ptr<const audio::BeatNetwork> network);

/// All excerpts, on two threads, with progress on stderr; results in order and the same as one by
/// one. When a signal came, those that were not finished are empty. `networks`: of each excerpt.
/// Errors: those of the first excerpt that failed.
[[nodiscard]] Expected<std::vector<std::optional<ExcerptBeats>>> analyze_excerpts(
    std::span<const audio::BeatExcerpt> excerpts,
    FileBeatMethod method,
    const std::vector<std::shared_ptr<const audio::BeatNetwork>>& networks,
    const std::string& what);

}  // namespace raks::apps
