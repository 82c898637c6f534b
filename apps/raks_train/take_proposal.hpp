// `raks train take --propose`, and `--music` without a table: a grid of beats for takes that nobody
// labelled.
#pragma once

#include <string>

#include "apps/raks_train/train_commands.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// Writes the table that is proposed, and a page beside it, for all clips. Errors: of the clips and
/// the music; a table whose name is no X.tsv; those of the files.
[[nodiscard]] ExitCode propose_take(const TrainTakeArguments& arguments);

/// The table for clips whose beats are those of the song, without a person. Errors: of the clips
/// and the music; no beats.
[[nodiscard]] Expected<std::string> beats_by_song(const TrainTakeArguments& arguments);

}  // namespace raks::apps
