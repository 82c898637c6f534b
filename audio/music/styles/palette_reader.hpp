#pragma once

#include "audio/music/styles/band_palette.hpp"
#include "base/toml_reader.hpp"

namespace raks::audio {

/// Reads one [[palette]] of a file of styles. Faults go to `complaints`; after one, the result is
/// not to be used.
[[nodiscard]] BandPalette read_palette(const toml::table& table, TomlComplaints& complaints);

}  // namespace raks::audio
