#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "audio/genre/tagger_network.hpp"
#include "base/expected.hpp"

/// Reads the music tagger's weights (docs/reference/files.md; scripts/convert_tagger.py writes
/// them).
namespace raks::audio {

/// First line of the file.
inline constexpr std::string_view kTaggerFormat = "raks-tagger";
inline constexpr int kTaggerVersion = 1;  ///< the one version

/// Reads and checks the weights. Errors, one line without the file's name: not such a file, a newer
/// version, cut short, damaged, arrays of other names or sizes, numbers out of range.
[[nodiscard]] Expected<TaggerNetwork> parse_tagger(std::string_view bytes);

/// Reads the weights from a file of at most 1 MiB. Errors: as read_file and parse_tagger. Threads:
/// workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const TaggerNetwork>> load_tagger(
    const std::filesystem::path& path);

}  // namespace raks::audio
