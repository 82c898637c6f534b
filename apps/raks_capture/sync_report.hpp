#pragma once

#include <string>

#include "apps/raks_capture/synchronise.hpp"

/// What `raks capture sync` says and writes.
namespace raks::apps {

/// A table of the cameras for people, and the line to type next where the song is known.
[[nodiscard]] std::string sync_table(const SyncResult& result, const SyncPlan& plan);
/// The same for programs: raks-sync, version 1 (docs/reference/files.md).
[[nodiscard]] std::string sync_json(const SyncResult& result, const SyncPlan& plan);
/// The song's clock as a file (`music.toml`): raks-music, version 1.
[[nodiscard]] std::string music_text(const SongSync& clock, const SyncPlan& plan);

}  // namespace raks::apps
