// Reading of dance habits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "base/toml_tree.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/figures/dance_mood.hpp"

namespace raks::motion {

/// Reads `pauses`, `rests`, `rest_at`, `mirror`, `endings`, `idle` and `[hands]` of the head of a
/// dance's file; what is absent stays as it is. Unknown endings, idle movements and what is wrong
/// in hands is left out, and the habits' notes say so. Errors, one line without the file's name: a
/// share that is none, an unknown place.
[[nodiscard]] Expected<void> read_habits(const toml::table& root, DanceHabits& habits);

/// Reads shapes of hands, `{ fist = 2, open = 1 }` or `"fist"`. What is wrong goes to `faults`, a
/// line each without the file's name, and counts as not said. Returns whether anything is left.
bool read_shapes(const toml::node& node,
                 HandShapeWeights& shapes,
                 std::vector<std::string>& faults);

/// What a dance's file says beside its figures.
struct WrittenHabits {
    DanceHabits habits;  ///< its notes begin with the file's name
    DanceMood mood;      ///< of faces; as it is by default where it cannot be read
    bool has_figures = false;
};
/// Reads DANCE.toml of a dance that may have no figures in it. Errors: not readable, not TOML; as
/// read_habits(). Threads: workers. Real-time: no.
[[nodiscard]] Expected<WrittenHabits> habits_of_file(const std::filesystem::path& path);

}  // namespace raks::motion
