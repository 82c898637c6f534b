// What is done with films: decoded as raks-decode does it, but in this process and without a cage.
#include <unistd.h>

#include "engine/decode/film_decoder.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

constexpr int kMostPictures = 40;

void must_be_whole(const engine::DecodedFilmPicture& picture) {
    must(picture.width >= 1 && picture.width <= engine::kMostFilmPixels);
    must(picture.height >= 1 && picture.height <= engine::kMostFilmPixels);
    must(picture.rgb.size() == std::size_t{3} * static_cast<std::size_t>(picture.width) *
                                   static_cast<std::size_t>(picture.height));
}

}  // namespace

bool read_film(std::string_view bytes) {
    const MemoryFile file(bytes);
    const auto window = audio::FileWindow::adopt(dup(file.descriptor()), "x");
    must(window.has_value());
    const auto film = engine::FilmDecoder::open("x", *window);
    if (!film) {
        must_be_one_line(film.error().message);
        return false;
    }
    must_be_one_line((*film)->info().format);
    double before = -1e300;
    for (int i = 0; i < kMostPictures; ++i) {
        const auto picture = (*film)->next();
        if (!picture) {
            must_be_one_line(picture.error().message);
            return false;
        }
        if (!*picture) {
            break;
        }
        must_be_whole(**picture);
        must((*picture)->seconds > before);
        before = (*picture)->seconds;
    }
    must_be_one_line((*film)->warning());
    return true;
}

}  // namespace raks::fuzz
