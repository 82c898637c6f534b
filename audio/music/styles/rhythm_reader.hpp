#pragma once

#include "audio/music/styles/rhythm_style.hpp"
#include "base/toml_reader.hpp"

namespace raks::audio {

/// A dance's name as styles give it: "none" becomes the empty name.
[[nodiscard]] std::string dance_named(std::string_view name);

/// Reads one [[rhythm]] of a file of styles. Faults go to `complaints`; after one, the result is
/// not to be used.
[[nodiscard]] RhythmStyle read_rhythm(const toml::table& table, TomlComplaints& complaints);

}  // namespace raks::audio
