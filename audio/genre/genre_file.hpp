#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"

/// Reads and writes genre models as JSON (docs/reference/files.md).
namespace raks::audio {

/// Value of the field `format`.
inline constexpr std::string_view kGenreFormat = "raks-genre";
inline constexpr int kGenreVersion = 4;  ///< newest version; older ones are read, too

/// JSON text of a model, numbers with six significant digits. Real-time: no.
[[nodiscard]] std::string genre_text(const GenreModel& model);

/// JSON text of the feature definition. Models, samples and shards whose texts differ do not fit
/// together.
[[nodiscard]] std::string features_text(const GenreFeatures& features);

/// Parses and validates a model of this or an earlier version. Errors, one line without the file's
/// name: no JSON, another format, a newer version, a field that is missing or does not fit,
/// features that this program does not compute.
[[nodiscard]] Expected<GenreModel> parse_genre(std::string_view text);

/// Reads a model from a file of at most 32 MiB. Errors: as read_file and parse_genre. Threads:
/// workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const GenreModel>> load_genre(
    const std::filesystem::path& path);
/// Writes a model to a file. Errors: the model is not valid; as write_file. Threads: workers.
/// Real-time: no.
[[nodiscard]] Expected<void> save_genre(const GenreModel& model, const std::filesystem::path& path);

}  // namespace raks::audio
