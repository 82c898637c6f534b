// Films with alpha, read back by FFmpeg's own program and laid over grounds.
#include <algorithm>
#include <array>
#include <cstdlib>

#include "tests/render/video/film_support.hpp"

namespace raks::render {
namespace {

constexpr int kSquaresAcross = 96;
constexpr int kSquaresDown = 64;
constexpr int kSquare = 16;

/// Squares of six colours, each in four alphas, premultiplied, on nothing.
Rgba squares() {
    constexpr std::array<std::array<int, 3>, 6> kColours = {
        {{255, 255, 255}, {220, 40, 30}, {20, 200, 60}, {40, 60, 230}, {120, 120, 120}, {0, 0, 0}}};
    constexpr std::array kAlphas = {255, 128, 64, 0};
    Rgba rgba(static_cast<std::size_t>(kSquaresAcross) * kSquaresDown * 4, 0);
    for (int y = 0; y < kSquaresDown; ++y) {
        for (int x = 0; x < kSquaresAcross; ++x) {
            const auto& colour = kColours.at(static_cast<std::size_t>(x / kSquare));
            const int alpha = kAlphas.at(static_cast<std::size_t>(y / kSquare));
            std::uint8_t* const pixel = &rgba[static_cast<std::size_t>(y * kSquaresAcross + x) * 4];
            for (std::size_t c = 0; c < 3; ++c) {
                pixel[c] = static_cast<std::uint8_t>((colour[c] * alpha + 127) / 255);
            }
            pixel[3] = static_cast<std::uint8_t>(alpha);
        }
    }
    return rgba;
}

/// The film's third picture as straight RGBA. FFmpeg's own reader of VP9 drops alpha.
Rgba read_back(const std::filesystem::path& film) {
    std::vector<std::string> arguments = {"ffmpeg", "-v", "error"};
    if (film.extension() == ".webm") {
        arguments.insert(arguments.end(), {"-c:v", "libvpx-vp9"});
    }
    if (std::filesystem::is_directory(film)) {
        arguments.insert(arguments.end(), {"-i", (film / "%06d.png").string()});
    } else {
        arguments.insert(arguments.end(), {"-i", film.string()});
    }
    arguments.insert(arguments.end(), {"-f", "rawvideo", "-pix_fmt", "rgba", "-"});
    const std::string bytes = test::run_program(arguments);
    constexpr std::size_t kPicture = static_cast<std::size_t>(kSquaresAcross) * kSquaresDown * 4;
    EXPECT_EQ(bytes.size(), 3 * kPicture) << film;
    const auto last = bytes.substr(bytes.size() - std::min(bytes.size(), kPicture));
    return {last.begin(), last.end()};
}

void write_squares(const std::filesystem::path& film) {
    auto writer = VideoWriter::create(film,
                                      {.width = kSquaresAcross,
                                       .height = kSquaresDown,
                                       .quality = VideoQuality::high,
                                       .has_alpha = true});
    ASSERT_TRUE(writer) << writer.error().message;
    const std::vector<float> sound(1600 * 2 * 3);
    ASSERT_TRUE((*writer)->add_sound(sound));
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE((*writer)->add_picture(squares()));
    }
    ASSERT_TRUE((*writer)->finish());
}

class AlphaFilm : public testing::TestWithParam<const char*> {};

// Inside of the squares: at their borders a codec may mix two colours, but no codec may darken.
TEST_P(AlphaFilm, lies_over_black_grey_and_white_as_it_was_drawn) {
    const raks::test::TemporaryFolder folder;
    const auto film = folder / GetParam();
    write_squares(film);
    const Rgba drawn = squares();
    const Rgba read = read_back(film);
    ASSERT_EQ(read.size(), drawn.size());
    constexpr int kTolerance = 6;
    constexpr int kBorder = 3;
    int compared = 0;
    for (int y = 0; y < kSquaresDown; ++y) {
        for (int x = 0; x < kSquaresAcross; ++x) {
            if (std::min(x % kSquare, y % kSquare) < kBorder ||
                std::max(x % kSquare, y % kSquare) >= kSquare - kBorder) {
                continue;
            }
            ++compared;
            const std::size_t at = static_cast<std::size_t>(y * kSquaresAcross + x) * 4;
            for (const int ground : {0, 128, 255}) {
                for (std::size_t c = at; c < at + 3; ++c) {
                    const int wanted = drawn[c] + ground * (255 - drawn[at + 3]) / 255;
                    const int seen = (read[c] * read[at + 3] + ground * (255 - read[at + 3])) / 255;
                    ASSERT_LE(std::abs(seen - wanted), kTolerance)
                        << x << "," << y << " channel " << c - at << " over " << ground;
                }
            }
        }
    }
    EXPECT_EQ(compared, 24 * 100);
}

INSTANTIATE_TEST_SUITE_P(Forms, AlphaFilm, testing::Values("x.mov", "x.webm", "pictures"));

// A white body on nothing: laid over white nothing of its edge may be seen.
TEST(AlphaFilms, a_white_edge_has_no_dark_rim_over_white) {
    const raks::test::TemporaryFolder folder;
    Rgba drawn(static_cast<std::size_t>(kSquaresAcross) * kSquaresDown * 4, 0);
    for (int y = 0; y < kSquaresDown; ++y) {
        for (int x = 0; x < kSquaresAcross; ++x) {
            const double away = std::hypot(x - 47.3, y - 31.6);
            const auto alpha = static_cast<std::uint8_t>(255.0 * std::clamp(20.5 - away, 0.0, 1.0));
            std::fill_n(&drawn[static_cast<std::size_t>(y * kSquaresAcross + x) * 4], 4, alpha);
        }
    }
    for (const char* const name : {"x.mov", "x.webm", "pictures"}) {
        auto writer = VideoWriter::create(folder / name,
                                          {.width = kSquaresAcross,
                                           .height = kSquaresDown,
                                           .quality = VideoQuality::high,
                                           .audio_channels = 0,
                                           .has_alpha = true});
        ASSERT_TRUE(writer) << writer.error().message;
        for (int i = 0; i < 3; ++i) {
            ASSERT_TRUE((*writer)->add_picture(drawn));
        }
        ASSERT_TRUE((*writer)->finish());
        const Rgba read = read_back(folder / name);
        for (std::size_t i = 0; i < read.size(); i += 4) {
            for (std::size_t c = i; c < i + 3; ++c) {
                ASSERT_GE((read[c] * read[i + 3] + 255 * (255 - read[i + 3])) / 255, 249)
                    << name << " pixel " << i / 4;
            }
        }
    }
}

TEST(AlphaFilms, say_of_themselves_that_they_have_it) {
    const raks::test::TemporaryFolder folder;
    write_squares(folder / "x.mov");
    EXPECT_EQ(probe(folder / "x.mov", "v:0", "codec_name,pix_fmt"), "prores,yuva444p12le");
    EXPECT_EQ(probe(folder / "x.mov", "a:0", "codec_name"), "pcm_s16le");
    write_squares(folder / "x.webm");
    const std::string tags = test::run_program({"ffprobe",
                                                "-v",
                                                "error",
                                                "-show_entries",
                                                "stream_tags=alpha_mode",
                                                "-of",
                                                "csv=p=0",
                                                (folder / "x.webm").string()});
    EXPECT_EQ(tags.substr(0, 1), "1");
}

TEST(AlphaFilms, other_forms_refuse_it_in_one_line) {
    const raks::test::TemporaryFolder folder;
    for (const char* const name : {"x.mp4", "x.mkv", "x.avi"}) {
        const auto refused = VideoWriter::create(folder / name, {.has_alpha = true});
        ASSERT_FALSE(refused) << name;
        EXPECT_NE(refused.error().message.find("has no alpha; use .mov, .webm"), std::string::npos)
            << refused.error().message;
        EXPECT_FALSE(VideoWriter::keeps_alpha(folder / name));
    }
    EXPECT_TRUE(VideoWriter::keeps_alpha(folder / "x.MOV"));
    EXPECT_TRUE(VideoWriter::keeps_alpha(folder / "folder"));
    EXPECT_FALSE(VideoWriter::keeps_alpha(folder / "x.xyz"));
}

}  // namespace
}  // namespace raks::render
