#include "render/video/film_module.hpp"

extern "C" __attribute__((visibility("default"))) void raks_open_film_1(
    const std::filesystem::path& path,
    raks::render::FilmForm form,
    const raks::render::VideoOptions& options,
    raks::render::OpenedFilm& film);

void raks_open_film_1(const std::filesystem::path& path,
                      raks::render::FilmForm form,
                      const raks::render::VideoOptions& options,
                      raks::render::OpenedFilm& film) {
    film = raks::render::create_film(path, form, options);
}
