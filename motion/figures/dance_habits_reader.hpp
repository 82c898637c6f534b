// Reading of dance habits.
#pragma once

#include "base/expected.hpp"
#include "base/toml_tree.hpp"
#include "motion/figures/dance_habits.hpp"

namespace raks::motion {

/// Reads `pauses`, `rests`, `mirror`, `rest_at`, `endings` and `idle` of the head of a dance's
/// file; what is absent stays as it is. Unknown endings and idle movements are left out, and the
/// habits' notes say so. Errors, one line without the file's name: a share that is none, an unknown
/// place.
[[nodiscard]] Expected<void> read_habits(const toml::table& root, DanceHabits& habits);

}  // namespace raks::motion
