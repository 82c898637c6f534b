// `raks train take --propose`: a grid of beats for takes that nobody labelled.
#pragma once

#include "apps/raks_train/train_commands.hpp"

namespace raks::apps {

/// Writes the table that is proposed, and a page beside it, for all clips. Errors: of the clips and
/// the music; a table whose name is no X.tsv; those of the files.
[[nodiscard]] ExitCode propose_take(const TrainTakeArguments& arguments);

}  // namespace raks::apps
