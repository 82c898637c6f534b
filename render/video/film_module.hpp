#pragma once

#include <filesystem>
#include <memory>

#include "base/pending_file.hpp"
#include "render/video/video_forms.hpp"

/// The door of the module raks-film.so, which has FFmpeg's encoders and is loaded when the first
/// film is written: the programs themselves load none of FFmpeg's libraries.
namespace raks::render {

/// What a film's opening gives.
using OpenedFilm = Expected<std::unique_ptr<VideoWriter>>;
/// As create_film(), into `film`; its file counts among `files`, the program's.
using OpenFilm = void (*)(const std::filesystem::path& path,
                          FilmForm form,
                          const VideoOptions& options,
                          PendingFiles& files,
                          OpenedFilm& film);
/// Under which the module has it. Of another build: another name.
inline constexpr const char* kOpenFilm = "raks_open_film_5";

}  // namespace raks::render
