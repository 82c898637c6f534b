#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "audio/beat/network/beat_network.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// Reads a beat network: {"format": "raks-beat-network", "version": 4, "units", "layers",
/// "lookahead", "made_with", "attribution", "parameters": [...], "others": [{"units", "layers",
/// "parameters": [...]}, ...], "confidence": [...], "bars": {"units", "layers", "parameters":
/// [...]}}. Without "others" (as in version 2) it is no ensemble, without "bars" (as in version 1)
/// it has no network for bars. Networks of versions 1 to 3 have no output for thirds. Errors: one
/// line with file and field: missing, another format, a newer version, sizes that do not fit, a
/// parameter that is no finite number. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const BeatNetwork>> load_network(
    const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
[[nodiscard]] Expected<std::shared_ptr<const BeatNetwork>> parse_network(std::string_view text,
                                                                         const std::string& name);

/// Origin of the weights, for the file.
struct NetworkNotes {
    std::string made_with;    ///< the command that trained them
    std::string attribution;  ///< credits of the training music
};

/// Writes a network, numbers with six significant digits: load_network gives these back.
/// Errors: parameters that are not finite or too large; as write_file.
[[nodiscard]] Expected<void> save_network(const BeatNetwork& network,
                                          const NetworkNotes& notes,
                                          const std::filesystem::path& path);

}  // namespace raks::audio
