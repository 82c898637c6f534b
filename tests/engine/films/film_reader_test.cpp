// Films come out picture by picture, each with its own time, as it is to be seen.
#include "engine/films/film_reader.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "base/file.hpp"
#include "tests/engine/films/film_files.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;
using films::kFilmHeight;
using films::kFilmPictures;
using films::kFilmRate;
using films::kFilmWidth;
using films::number_of;
using films::pixel;
using films::read_film;
using films::ReadFilm;
using films::run_ffmpeg;

constexpr double kStampError = 0.0011;  // seconds: Matroska counts milliseconds

class Films : public ::testing::Test {
 protected:
    [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }
    /// The numbered film under this name.
    [[nodiscard]] fs::path film(const std::string& name) const {
        films::write_numbered_film(path(name));
        return path(name);
    }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
    }

    raks::test::TemporaryFolder folder_;
};

// Red, green and blue in the quarters where numbered_picture() has them.
void expect_upright(const FilmPicture& picture) {
    const auto is_near = [](int value, int level) { return std::abs(value - level) <= 16; };
    const std::array<std::pair<int, int>, 3> places{{{1, 1}, {3, 1}, {1, 3}}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::vector<int> colour = pixel(
            picture, picture.width * places[i].first / 4, picture.height * places[i].second / 4);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_TRUE(is_near(colour[c], c == i ? 200 : 30))
                << "place " << i << " channel " << c << ": " << colour[c];
        }
    }
}

TEST_F(Films, give_every_picture_with_its_time_and_colours) {
    for (const std::string name : {"a.mp4", "a.mkv", "a.webm", "a.avi"}) {
        const ReadFilm read = read_film(film(name));
        EXPECT_EQ(read.error + read.warning, "") << name;
        EXPECT_EQ(read.info.width, kFilmWidth);
        EXPECT_EQ(read.info.height, kFilmHeight);
        EXPECT_EQ(read.info.turned, 0);
        EXPECT_NEAR(read.info.pictures_per_second, kFilmRate, 0.01);
        EXPECT_NEAR(read.info.claimed_seconds.value_or(0.0), 1.0, 0.05);
        ASSERT_EQ(read.pictures.size(), kFilmPictures) << name;
        for (int i = 0; i < kFilmPictures; ++i) {
            const FilmPicture& picture = read.pictures[static_cast<std::size_t>(i)];
            EXPECT_NEAR(picture.seconds, static_cast<double>(i) / kFilmRate, kStampError) << name;
            EXPECT_EQ(number_of(picture), i) << name;
            expect_upright(picture);
        }
    }
}

TEST_F(Films, at_a_varying_rate_keep_the_times_of_their_pictures) {
    const fs::path steady = film("steady.mp4");
    for (const std::string name : {"vfr.mp4", "vfr.mkv"}) {
        run_ffmpeg(
            {"-i", steady.string(), "-an", "-vf", "select='lt(mod(n,7),3)'", "-vsync", "vfr"},
            path(name));
        const ReadFilm read = read_film(path(name));
        ASSERT_EQ(read.pictures.size(), 14U) << name << read.error;
        for (const FilmPicture& picture : read.pictures) {
            EXPECT_LT(number_of(picture) % 7, 3);
            EXPECT_NEAR(picture.seconds, number_of(picture) / double(kFilmRate), kStampError)
                << name;
        }
    }
}

TEST_F(Films, are_turned_as_their_metadata_says) {
    const fs::path plain = film("plain.mp4");
    for (const int degrees : {90, 180, 270}) {
        const fs::path turned = path(std::to_string(degrees) + ".mp4");
        run_ffmpeg({"-i",
                    plain.string(),
                    "-c",
                    "copy",
                    "-metadata:s:v",
                    "rotate=" + std::to_string(degrees)},
                   turned);
        const ReadFilm read = read_film(turned);
        ASSERT_EQ(read.pictures.size(), kFilmPictures) << read.error;
        EXPECT_EQ(read.info.turned, 360 - degrees);  // ffmpeg counts the other way
        const FilmPicture& picture = read.pictures.front();
        EXPECT_EQ(picture.width, degrees == 180 ? kFilmWidth : kFilmHeight);
        EXPECT_EQ(read.info.width, picture.width);
        EXPECT_EQ(read.info.height, picture.height);
        // What ffmpeg shows of it.
        const std::string shown = raks::test::run_program({"ffmpeg",
                                                           "-v",
                                                           "error",
                                                           "-i",
                                                           turned.string(),
                                                           "-frames:v",
                                                           "1",
                                                           "-f",
                                                           "rawvideo",
                                                           "-pix_fmt",
                                                           "rgb24",
                                                           "-"});
        ASSERT_EQ(shown.size(), picture.rgb.size());
        double differ = 0.0;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            differ += std::abs(picture.rgb[i] - static_cast<std::uint8_t>(shown[i]));
        }
        EXPECT_LT(differ / static_cast<double>(shown.size()), 6.0) << degrees;
    }
}

TEST_F(Films, of_all_codecs_on_the_list_are_read) {
    const fs::path plain = film("plain.avi");
    const std::vector<std::pair<std::string, std::string>> kinds = {{"libx264", "h264.mov"},
                                                                    {"libx265", "hevc.mp4"},
                                                                    {"mpeg4", "mpeg4.avi"},
                                                                    {"mjpeg", "mjpeg.mov"},
                                                                    {"libvpx", "vp8.webm"},
                                                                    {"libvpx-vp9", "vp9.webm"},
                                                                    {"libaom-av1", "av1.mkv"},
                                                                    {"prores_ks", "prores.mov"},
                                                                    {"rawvideo", "raw.avi"},
                                                                    {"png", "png.mov"}};
    for (const auto& [encoder, name] : kinds) {
        std::vector<std::string> arguments{"-i", plain.string(), "-an", "-frames:v", "4"};
        arguments.insert(arguments.end(), {"-c:v", encoder});
        if (encoder == "libx265") {
            arguments.insert(arguments.end(), {"-x265-params", "log-level=none"});
        } else if (encoder == "libaom-av1") {
            arguments.insert(arguments.end(), {"-cpu-used", "8"});
        }
        run_ffmpeg(arguments, path(name));
        const ReadFilm read = read_film(path(name));
        EXPECT_EQ(read.error + read.warning, "") << name;
        ASSERT_EQ(read.pictures.size(), 4U) << name;
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(read.pictures[i].seconds, static_cast<double>(i) / kFilmRate, kStampError);
            expect_upright(read.pictures[i]);
        }
    }
    run_ffmpeg({"-i", plain.string(), "-an", "-c:v", "ffv1"}, path("other.mkv"));
    const std::string error = read_film(path("other.mkv")).error;
    EXPECT_NE(error.find("other.mkv: its pictures (ffv1) cannot be decoded; H.264, "),
              std::string::npos)
        << error;
}

TEST_F(Films, count_time_from_what_comes_first_of_sound_and_picture) {
    const fs::path plain = film("plain.mp4");
    for (const auto& [delayed, first] : {std::pair("0:v", 0.5), std::pair("0:a", 0.0)}) {
        const std::string other = std::string(delayed) == "0:v" ? "1:a" : "1:v";
        run_ffmpeg({"-itsoffset",
                    "0.5",
                    "-i",
                    plain.string(),
                    "-i",
                    plain.string(),
                    "-map",
                    delayed,
                    "-map",
                    other,
                    "-c",
                    "copy"},
                   path("late.mkv"));
        const ReadFilm read = read_film(path("late.mkv"));
        ASSERT_EQ(read.pictures.size(), kFilmPictures) << read.error;
        EXPECT_NEAR(read.pictures.front().seconds, first, 0.025) << delayed;
    }
}

// Colour is halved in a film. Its places must not move what is coloured.
TEST_F(Films, keep_coloured_things_where_they_are) {
    constexpr double kX = 41.3;
    constexpr double kY = 30.6;
    constexpr double kRadius = 6.0;
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < kFilmHeight; ++y) {
        for (int x = 0; x < kFilmWidth; ++x) {
            // The edge is smooth over a pixel.
            const double inside = std::clamp(kRadius + 0.5 - std::hypot(x - kX, y - kY), 0.0, 1.0);
            const auto level = [inside](double disc) {
                return static_cast<std::uint8_t>(100.0 + inside * (disc - 100.0));
            };
            rgba.insert(rgba.end(), {level(40), level(150), level(60), 255});
        }
    }
    for (const std::string name : {"disc.mp4", "disc.avi"}) {
        auto writer = render::VideoWriter::create(path(name),
                                                  {.width = kFilmWidth,
                                                   .height = kFilmHeight,
                                                   .quality = render::VideoQuality::high,
                                                   .audio_channels = 0});
        ASSERT_TRUE(writer);
        ASSERT_TRUE((*writer)->add_picture(rgba));
        ASSERT_TRUE((*writer)->finish());
        const ReadFilm read = read_film(path(name));
        ASSERT_EQ(read.pictures.size(), 1U) << read.error;
        double weight = 0.0;
        double sum_x = 0.0;
        double sum_y = 0.0;
        for (int y = 18; y < 44; ++y) {
            for (int x = 28; x < 54; ++x) {
                const std::vector<int> colour = pixel(read.pictures.front(), x, y);
                const double green = std::max(0, colour[1] - colour[0] - 4);
                weight += green;
                sum_x += green * x;
                sum_y += green * y;
            }
        }
        EXPECT_NEAR(sum_x / weight, kX, 0.12) << name;
        EXPECT_NEAR(sum_y / weight, kY, 0.12) << name;
    }
}

TEST_F(Films, of_numbered_pictures_are_read_in_order) {
    films::write_numbered_film(path("folder"), 0);
    fs::remove(path("folder") / "000003.png");
    run_ffmpeg({"-i", (path("folder") / "000007.png").string(), "-q:v", "2"},
               path("folder") / "view_000040.JPG");
    std::ofstream(path("folder") / "notes.txt") << "no picture";
    const ReadFilm read = read_film(path("folder"), {.folder_pictures_per_second = 10.0});
    EXPECT_EQ(read.error + read.warning, "");
    ASSERT_EQ(read.pictures.size(), kFilmPictures);
    EXPECT_DOUBLE_EQ(read.pictures[1].seconds, 0.1);
    EXPECT_DOUBLE_EQ(read.pictures[2].seconds, 0.3);
    EXPECT_EQ(number_of(read.pictures[2]), 3);
    EXPECT_DOUBLE_EQ(read.pictures.back().seconds, 3.9);
    EXPECT_EQ(number_of(read.pictures.back()), 6);
    EXPECT_EQ(read_film(path("folder") / "000001.png").pictures.size(), 1U);
}

TEST_F(Films, that_cannot_be_read_are_refused_with_one_line) {
    const fs::path plain = film("plain.mp4");
    write("empty.mp4", "");
    write("text.mp4", std::string(4000, 'x') + "\n");
    run_ffmpeg({"-i", plain.string(), "-vn"}, path("sound.m4a"));
    std::string bytes = read_file(plain).value();
    write("cut.mp4", bytes.substr(0, bytes.size() / 3));
    fs::create_directory(path("none"));
    fs::create_directory(path("twice"));
    for (const std::string name : {"twice/1.png", "twice/01.png"}) {
        write(name, "x");
    }
    fs::create_directory(path("bad"));
    write("bad/1.png", "no picture");
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const std::vector<std::pair<std::string, std::string>> lines = {
        {"missing.mp4", "missing.mp4: is not there"},
        {"empty.mp4", "empty.mp4: is empty"},
        {"text.mp4", "text.mp4: is not a film or picture that can be read"},
        {"sound.m4a", "sound.m4a: has no track of pictures"},
        {"none", "none: has no numbered pictures"},
        {"twice", "have the same number; keep one of them"},
        {"bad", "1.png: is not a film or picture that can be read"},
        {"pipe", "pipe: is neither a file nor a folder"}};
    for (const auto& [name, line] : lines) {
        const std::string error = read_film(path(name)).error;
        EXPECT_NE(error.find(line), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST_F(Films, that_are_cut_off_give_what_there_is_and_say_so) {
    constexpr std::size_t kAll = 60;
    const auto make = [this](const std::string& name, std::vector<std::string> how = {}) {
        std::vector<std::string> all{
            "-f", "lavfi", "-i", "testsrc2=size=320x240:rate=30:duration=2", "-g", "10"};
        all.insert(all.end(), how.begin(), how.end());
        run_ffmpeg(all, path(name));
        return read_file(path(name)).value();
    };
    const auto is_part = [](const ReadFilm& read) {
        return read.pictures.size() > 10U && read.pictures.size() < kAll - 5;
    };
    for (const std::string ending : {".mkv", ".avi"}) {
        const std::string bytes = make("whole" + ending);
        write("cut" + ending, bytes.substr(0, bytes.size() / 2));
        const ReadFilm read = read_film(path("cut" + ending));
        EXPECT_TRUE(is_part(read)) << ending << read.pictures.size() << read.error;
        EXPECT_NE(read.warning.find("is damaged or cut off at "), std::string::npos)
            << read.warning;
    }
    // Its index in front, so that a part of it can be found.
    const std::string bytes = make("front.mp4", {"-movflags", "+faststart"});
    write("cut.mp4", bytes.substr(0, bytes.size() * 2 / 3));
    const ReadFilm read = read_film(path("cut.mp4"));
    EXPECT_TRUE(is_part(read)) << read.pictures.size() << read.error;
    EXPECT_NE(read.warning.find("cut off at "), std::string::npos) << read.warning;
    // Its index at the end.
    const std::string plain = make("whole.mp4");
    write("headless.mp4", plain.substr(0, plain.size() / 2));
    EXPECT_NE(read_film(path("headless.mp4")).error.find("before its index"), std::string::npos)
        << read_film(path("headless.mp4")).error;
}

TEST_F(Films, over_8192_pixels_are_refused) {
    run_ffmpeg({"-f", "lavfi", "-i", "color=red:size=8200x16", "-frames:v", "1"}, path("wide.png"));
    EXPECT_NE(read_film(path("wide.png")).error.find("has pictures of 8200 x 16, at most"),
              std::string::npos)
        << read_film(path("wide.png")).error;
}

TEST_F(Films, of_8192_by_8192_pixels_are_read_in_the_memory_that_is_allowed) {
    run_ffmpeg({"-f", "lavfi", "-i", "color=0x804020:size=8192x8192", "-frames:v", "1"},
               path("large.jpg"));
    const ReadFilm read = read_film(path("large.jpg"));
    ASSERT_EQ(read.pictures.size(), 1U) << read.error;
    EXPECT_EQ(read.pictures.front().rgb.size(), std::size_t{8192} * 8192 * 3);
}

// Those that have a film.
std::vector<pid_t> film_decoders() { return raks::test::children_of(::getpid()); }

TEST_F(Films, whose_decoder_is_killed_end_there_and_say_so) {
    run_ffmpeg({"-f", "lavfi", "-i", "testsrc=size=1280x720:rate=30:duration=2", "-c:v", "mjpeg"},
               path("long.avi"));
    auto reader = FilmReader::open(path("long.avi"));
    ASSERT_TRUE(reader) << reader.error().message;
    ASSERT_TRUE((*reader)->next().value());
    ASSERT_EQ(film_decoders().size(), 1U);
    ::kill(film_decoders().front(), SIGKILL);
    std::size_t count = 1;
    while ((*reader)->next().value()) {
        ++count;
    }
    EXPECT_LT(count, 20U);
    EXPECT_NE((*reader)->warning().find("its decoder ended too soon (killed by SIGKILL) at 0."),
              std::string::npos)
        << (*reader)->warning();
    EXPECT_FALSE((*reader)->next().value());
    reader->reset();
    EXPECT_TRUE(film_decoders().empty());
}

TEST_F(Films, stop_when_they_are_told_to) {
    const fs::path plain = film("plain.mp4");
    bool is_stopped = false;
    auto reader =
        FilmReader::open(plain, {.is_stop_requested = [&is_stopped] { return is_stopped; }});
    ASSERT_TRUE(reader);
    ASSERT_TRUE((*reader)->next());
    for (const pid_t pid : film_decoders()) {
        ::kill(pid, SIGSTOP);
    }
    is_stopped = true;
    Expected<std::optional<FilmPicture>> last;
    while ((last = (*reader)->next()) && *last) {
    }
    ASSERT_FALSE(last);
    EXPECT_NE(last.error().message.find("plain.mp4: was stopped"), std::string::npos);
}

}  // namespace
}  // namespace raks::engine
