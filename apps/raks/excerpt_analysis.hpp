#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "audio/beat/network/beat_network.hpp"
#include "audio/evaluate/beat_corpus.hpp"

/// Runs our own trackers over the excerpts of a corpus, for `raks eval beats`.
namespace raks::apps {

/// The result of one tracker for one excerpt; times to the microsecond, as `raks analyze --json`
/// writes them.
struct ExcerptBeats {
    audio::BeatEstimate estimate;  ///< beats and predictions
    std::string warning;  ///< what is wrong with a file that still plays; empty when nothing is
};

/// Tracks one file from start to end: beats as announced and as predicted, without look-ahead;
/// the methods that have the whole file predict none. `network`: for the pointer method;
/// null: none. Errors: as MusicSource::open.
[[nodiscard]] Expected<ExcerptBeats> analyze_excerpt(
    const Path& audio, FileBeatMethod method, std::shared_ptr<const audio::BeatNetwork> network);

/// The same for all excerpts, on two threads, with progress on stderr; results are in order and the
/// same as one by one. After a signal those that were not finished are empty. `networks`: one an
/// excerpt. `what`: stands before the progress. Errors: those of the first excerpt, in order, that
/// failed.
[[nodiscard]] Expected<std::vector<std::optional<ExcerptBeats>>> analyze_excerpts(
    std::span<const audio::BeatExcerpt> excerpts,
    FileBeatMethod method,
    const std::vector<std::shared_ptr<const audio::BeatNetwork>>& networks,
    const std::string& what);

}  // namespace raks::apps
