#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "audio/genre/genre_model.hpp"
#include "base/expected.hpp"

namespace raks::audio {

inline constexpr std::string_view kGenreFormat = "raks-genre";
inline constexpr int kGenreVersion = 4;

/// JSON text of a model (docs/reference/files.md); numbers with six digits.
[[nodiscard]] std::string genre_text(const GenreModel& model);

/// What the numbers of a model are about, as its file says it: two that differ do not fit.
[[nodiscard]] std::string features_text(const GenreFeatures& features);

/// Reads (earlier versions, too) and validates. Errors, one line without
/// the file: no JSON, another format, a newer version, a field that is missing or does not fit,
/// features that this program does not hear.
[[nodiscard]] Expected<GenreModel> parse_genre(std::string_view text);

/// The same from and to a file (at most 32 MiB). Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const GenreModel>> load_genre(
    const std::filesystem::path& path);
[[nodiscard]] Expected<void> save_genre(const GenreModel& model, const std::filesystem::path& path);

}  // namespace raks::audio
