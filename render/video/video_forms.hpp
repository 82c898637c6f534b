#pragma once

#include <optional>
#include <string_view>

#include "base/file.hpp"
#include "render/video/video_writer.hpp"

/// The forms of a film, each a VideoWriter of its own. Options are valid when they come here.
namespace raks::render {

/// Container of a film; codecs follow from it.
enum class FilmForm { mp4, mkv, webm, avi, mov };

/// The form of an ending in lower case, ".mp4"; nothing for others.
[[nodiscard]] constexpr std::optional<FilmForm> film_form_of(std::string_view ending) noexcept {
    if (ending == ".mp4") {
        return FilmForm::mp4;
    }
    if (ending == ".mkv") {
        return FilmForm::mkv;
    }
    if (ending == ".webm") {
        return FilmForm::webm;
    }
    if (ending == ".mov") {
        return FilmForm::mov;
    }
    return ending == ".avi" ? std::optional(FilmForm::avi) : std::nullopt;
}

/// A film through FFmpeg's libraries.
[[nodiscard]] Expected<std::unique_ptr<VideoWriter>> create_film(const std::filesystem::path& path,
                                                                 FilmForm form,
                                                                 const VideoOptions& options);

/// A folder of numbered PNG files.
[[nodiscard]] Expected<std::unique_ptr<VideoWriter>> create_picture_folder(
    const std::filesystem::path& path, const VideoOptions& options);

/// One clear line when a picture's bytes do not fit the size.
[[nodiscard]] Expected<void> check_picture(std::span<const std::uint8_t> rgba,
                                           const VideoOptions& options);

}  // namespace raks::render
