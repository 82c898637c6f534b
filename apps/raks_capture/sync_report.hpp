#pragma once

#include <string>
#include <string_view>

#include "apps/raks_capture/synchronise.hpp"

/// What `raks capture sync` says and writes.
namespace raks::apps {

/// A table of the cameras for people, and the line to type next where the song is known.
[[nodiscard]] std::string sync_table(const SyncResult& result, const SyncPlan& plan);
/// The same for programs: raks-sync, version 1 (docs/reference/files.md).
[[nodiscard]] std::string sync_json(const SyncResult& result, const SyncPlan& plan);
/// The song's clock as a file (`music.toml`): raks-music, version 1.
[[nodiscard]] std::string music_text(const SongSync& clock, const SyncPlan& plan);
/// The song's clock of such a file. `file` names it in errors: not TOML, another format, a number
/// that is missing, not finite or beyond what clocks do (a day, 5000 ppm).
[[nodiscard]] Expected<SongSync> read_music(std::string_view text, const std::string& file);

}  // namespace raks::apps
