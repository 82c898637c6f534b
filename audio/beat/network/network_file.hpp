#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "audio/beat/network/beat_network.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Reads a beat network: {"format": "raks-beat-network", "version": 3, "units", "layers",
/// "lookahead", "made_with", "attribution", "parameters": [...], "others": [{"units", "layers",
/// "parameters": [...]}, ...], "bars": {"units", "layers", "parameters": [...]}}. Without "others"
/// (as in version 2) it hears alone, without "bars" (as in version 1) it hears none.
/// Errors: one line with file and field: missing, another format, a newer version, sizes that do
/// not fit, a parameter that is no finite number.
[[nodiscard]] Expected<std::shared_ptr<const BeatNetwork>> load_network(
    const std::filesystem::path& path);

/// Where the weights come from, for the file.
struct NetworkNotes {
    std::string made_with;    ///< the command
    std::string attribution;  ///< of the music that it learnt from
};

/// Writes with six digits; load_network gives back what a reader of those digits gets.
[[nodiscard]] Expected<void> save_network(const BeatNetwork& network,
                                          const NetworkNotes& notes,
                                          const std::filesystem::path& path);

}  // namespace raks::audio
