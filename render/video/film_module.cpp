#include "render/video/film_module.hpp"

#include "base/pending_file.hpp"

extern "C" __attribute__((visibility("default"))) void raks_open_film_5(
    const std::filesystem::path& path,
    raks::render::FilmForm form,
    const raks::render::VideoOptions& options,
    raks::PendingFiles& files,
    raks::render::OpenedFilm& film);

void raks_open_film_5(const std::filesystem::path& path,
                      raks::render::FilmForm form,
                      const raks::render::VideoOptions& options,
                      raks::PendingFiles& files,
                      raks::render::OpenedFilm& film) {
    raks::share_pending_files(files);
    film = raks::render::create_film(path, form, options);
}
