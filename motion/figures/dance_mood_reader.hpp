// Reading of dance moods.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/figures/dance_mood.hpp"

namespace raks::motion {

/// Reads `mood` of the head of a dance's file (docs/reference/files.md); without one the mood is as
/// it is by default. Everything else in the file is passed over. `name` stands for the file in
/// errors, one line: not TOML, `mood` is no table, a key or an emotion that is unknown (the nearest
/// name is given), a number out of its range. Threads: workers. Real-time: no.
[[nodiscard]] Expected<DanceMood> parse_mood(std::string_view toml, const std::string& name);

/// The same from a file. Errors: also a file that cannot be read.
[[nodiscard]] Expected<DanceMood> load_mood(const std::filesystem::path& path);

}  // namespace raks::motion
