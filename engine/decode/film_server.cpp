#include "engine/decode/film_server.hpp"

#include <string>

namespace raks::engine {

using audio::DecodeKind;

void FilmServer::run() {
    int descriptor = -1;
    while (audio::receive_message(socket_, asked_, std::span(&descriptor, 1)) == Talk::good &&
           asked_.kind == DecodeKind::open_film && descriptor >= 0 && serve(descriptor)) {
    }
}

bool FilmServer::send(DecodeKind kind, std::string_view text) {
    answer_.kind = kind;
    answer_.set_text(text);
    return audio::send_message(socket_, answer_) == Talk::good;
}

// False: nothing more is to be done.
bool FilmServer::serve(int descriptor) {
    const std::string name(asked_.words());
    const auto window = audio::FileWindow::adopt(descriptor, name);
    if (!window) {
        return send(DecodeKind::failed, window.error().message);
    }
    const auto film = FilmDecoder::open(name, *window);
    return film ? send_film(**film) : send(DecodeKind::failed, film.error().message);
}

bool FilmServer::send_film(FilmDecoder& film) {
    const DecodedFilm& info = film.info();
    answer_.head.claimed_seconds = info.claimed_seconds;
    answer_.head.format_bytes = static_cast<std::uint32_t>(info.format.size());
    answer_.head.is_confined = is_confined_ ? 1U : 0U;
    answer_.picture = {
        .seconds = info.recorded,
        .pictures_per_second = info.pictures_per_second,
        .width = info.width,
        .height = info.height,
        .turned = info.turned,
    };
    if (!send(DecodeKind::opened, info.format)) {
        return false;
    }
    for (;;) {
        const auto picture = film.next();
        if (!picture) {
            return send(DecodeKind::failed, picture.error().message);
        }
        if (!*picture) {
            return send(DecodeKind::film_end, film.warning());
        }
        if (!send_picture(**picture)) {
            return false;
        }
    }
}

bool FilmServer::send_picture(const DecodedFilmPicture& picture) {
    answer_.picture.seconds = picture.seconds;
    answer_.picture.width = picture.width;
    answer_.picture.height = picture.height;
    return send(DecodeKind::picture, {}) &&
           send_all(pictures_, std::as_bytes(picture.rgb), kNever) == Talk::good;
}

}  // namespace raks::engine
