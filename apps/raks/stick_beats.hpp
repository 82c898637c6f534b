// `raks stick --counts`: the beats of takes, looked at and set right.
#pragma once

#include "apps/raks/commands.hpp"

namespace raks::apps {

/// Draws strips of the takes in the table (`--strips`), or opens the window in which beats are set
/// right (`--edit`). Errors: the table's; a take that is not among the clips; beats beyond the end
/// of their clip; those of reading clips and of drawing.
[[nodiscard]] ExitCode stick_beats(const StickArguments& arguments);

}  // namespace raks::apps
