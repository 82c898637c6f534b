#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/films/film_reader.hpp"
#include "render/video/video_writer.hpp"
#include "tests/support/run_program.hpp"

namespace raks::engine::films {

inline constexpr int kFilmWidth = 96;
inline constexpr int kFilmHeight = 64;
inline constexpr int kFilmPictures = 30;
inline constexpr int kFilmRate = 30;

/// The grey level that tells picture `number` from the others.
inline int grey_of(int number) { return 24 + 7 * number; }

/// RGBA: the upper left quarter red, the upper right green, the lower left blue, the rest grey.
inline std::vector<std::uint8_t> numbered_picture(int number) {
    std::vector<std::uint8_t> rgba;
    const auto grey = static_cast<std::uint8_t>(grey_of(number));
    for (int y = 0; y < kFilmHeight; ++y) {
        for (int x = 0; x < kFilmWidth; ++x) {
            const bool is_left = x < kFilmWidth / 2;
            const bool is_upper = y < kFilmHeight / 2;
            const auto level = [&](bool is_on) {
                return is_left || is_upper ? std::uint8_t(is_on ? 200 : 30) : grey;
            };
            rgba.insert(rgba.end(),
                        {level(is_left && is_upper),
                         level(!is_left && is_upper),
                         level(is_left && !is_upper),
                         255});
        }
    }
    return rgba;
}

/// A film of the product's own writer, its pictures numbered; `sound` channels of silence.
inline void write_numbered_film(const std::filesystem::path& path, int sound = 1) {
    auto film = render::VideoWriter::create(path,
                                            {.width = kFilmWidth,
                                             .height = kFilmHeight,
                                             .rate = {kFilmRate, 1},
                                             .quality = render::VideoQuality::high,
                                             .audio_channels = sound});
    ASSERT_TRUE(film) << film.error().message;
    for (int i = 0; i < kFilmPictures; ++i) {
        ASSERT_TRUE((*film)->add_picture(numbered_picture(i)));
        if (sound > 0) {
            ASSERT_TRUE((*film)->add_sound(
                std::vector<float>(static_cast<std::size_t>(sound) * 48'000 / kFilmRate)));
        }
    }
    ASSERT_TRUE((*film)->finish());
}

/// Runs ffmpeg with these arguments between its usual first ones and the film to write.
inline void run_ffmpeg(std::vector<std::string> arguments, const std::filesystem::path& out) {
    std::vector<std::string> command{"ffmpeg", "-nostdin", "-v", "error", "-y"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.push_back(out.string());
    raks::test::run_program(command);
}

/// Red, green and blue at a pixel.
inline std::vector<int> pixel(const FilmPicture& picture, int x, int y) {
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
             static_cast<std::size_t>(x));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

/// Which numbered picture this is, by its lower right quarter.
inline int number_of(const FilmPicture& picture) {
    const int grey = pixel(picture, picture.width * 3 / 4, picture.height * 3 / 4)[1];
    return static_cast<int>(std::lround((grey - 24) / 7.0));
}

/// A film read to its end.
struct ReadFilm {
    FilmInfo info;
    std::vector<FilmPicture> pictures;
    std::string error;  ///< of open() or next(); empty: none
    std::string warning;
};

inline ReadFilm read_film(const std::filesystem::path& path, const FilmOptions& options = {}) {
    ReadFilm read;
    auto film = FilmReader::open(path, options);
    if (!film) {
        read.error = film.error().message;
        return read;
    }
    read.info = (*film)->info();
    for (;;) {
        auto picture = (*film)->next();
        if (!picture || !*picture) {
            read.error = picture ? "" : picture.error().message;
            read.warning = (*film)->warning();
            return read;
        }
        read.pictures.push_back(std::move(**picture));
    }
}

}  // namespace raks::engine::films
