#include "base/pending_file.hpp"
#include "base/program_parts.hpp"
#include "render/video/film_module.hpp"

namespace raks::render {

OpenedFilm create_film(const std::filesystem::path& path,
                       FilmForm form,
                       const VideoOptions& options) {
    static const Expected<void*> open =
        load_program_part("raks-film.so", "lib/raks", "RAKS_FILM_MODULE", kOpenFilm);
    if (!open) {
        return fail(path.string() + ": " + open.error().message);
    }
    OpenedFilm film;
    reinterpret_cast<OpenFilm> (*open)(path, form, options, pending_files(), film);
    return film;
}

}  // namespace raks::render
