#include "render/video/video_writer.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <utility>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/render/video/film_support.hpp"

namespace raks::render {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 96;
const VideoOptions kSmall{.width = kWidth, .height = kHeight};

/// A film of noise over a tone: `pictures` pictures, 30 a second.
Expected<void> write_noise(const std::filesystem::path& path,
                           int pictures,
                           const VideoOptions& options = kSmall) {
    auto film = VideoWriter::create(path, options);
    if (!film) {
        return fail(film.error());
    }
    std::vector<float> sound(1600 * 2);
    for (int i = 0; i < pictures; ++i) {
        for (std::size_t s = 0; s < sound.size(); ++s) {
            sound[s] = std::sin(static_cast<float>(s) * 0.05F);
        }
        if (auto added = (*film)->add_sound(sound); !added) {
            return added;
        }
        const auto seed = static_cast<std::uint64_t>(i);
        if (auto added = (*film)->add_picture(noise_picture(options.width, options.height, seed));
            !added) {
            return added;
        }
    }
    return (*film)->finish();
}

std::string error_of(const std::filesystem::path& path, const VideoOptions& options) {
    const auto film = VideoWriter::create(path, options);
    return film ? "no error" : film.error().message;
}

TEST(FrameRate, decimal_numbers_mean_the_fractions_of_television) {
    struct Row {
        double fps;
        int numerator;
        int denominator;
    };
    for (const Row& row : {Row{30.0, 30, 1},
                           Row{25.0, 25, 1},
                           Row{29.97, 30'000, 1001},
                           Row{23.976, 24'000, 1001},
                           Row{23.98, 24'000, 1001},
                           Row{59.94, 60'000, 1001},
                           Row{12.5, 25, 2},
                           Row{7.125, 57, 8}}) {
        EXPECT_EQ(FrameRate::nearest(row.fps).numerator, row.numerator) << row.fps;
        EXPECT_EQ(FrameRate::nearest(row.fps).denominator, row.denominator) << row.fps;
    }
}

TEST(VideoWriter, faults_of_the_options_are_one_line_that_says_what_to_do) {
    const raks::test::TemporaryFolder folder;
    const std::string x = (folder / "x").string();
    struct Row {
        std::string name;
        VideoOptions options;
        std::string message;
    };
    const std::vector<Row> rows = {
        {".ogv",
         {},
         ": unknown kind of film \".ogv\"; known: .mp4, .mkv, .webm, .avi, with alpha .mov, or a "
         "folder for numbered .png pictures"},
        {".mov", {}, ": a .mov is written with alpha alone; use .mp4"},
        {".mp4",
         {.width = 641, .height = 360},
         ": a film of 641x360 cannot be encoded; sides must be even: use 640x360"},
        {".avi",
         {.width = 640, .height = 359},
         ": a film of 640x359 cannot be encoded; sides must be even: use 640x358"},
        {"",
         {.width = 0, .height = -5},
         ": a picture of 0x-5 cannot be written; each side must be 16 to 8192"},
        {".mp4",
         {.width = 100'000},
         ": a picture of 100000x720 cannot be written; each side must be 16 to 8192"},
        {".mp4", {.rate = {0, 1}}, ": a rate of 0/1 pictures a second; must be 1 to 240"},
        {".mp4", {.rate = {30, -1}}, ": a rate of 30/-1 pictures a second; must be 1 to 240"},
        {".mp4", {.audio_channels = 6}, ": sound of 6 channels; must be 1 or 2, or 0 for none"},
        {".avi", {.audio_rate = 1}, ": sound of 1 Hz; must be 8000 to 192000"},
    };
    for (const Row& row : rows) {
        EXPECT_EQ(error_of(x + row.name, row.options), x + row.name + row.message);
        const auto checked = VideoWriter::check(x + row.name, row.options);
        EXPECT_FALSE(checked);
        EXPECT_EQ(checked ? "" : checked.error().message, x + row.name + row.message);
        EXPECT_TRUE(folder.is_empty());
    }
    EXPECT_EQ(
        error_of(folder / "no/such/x.mp4", {}),
        (folder / "no/such/x.mp4").string() + ": cannot be written: No such file or directory");
    EXPECT_EQ(error_of(folder / "no/such/x", {}),
              (folder / "no/such/x").string() + ": cannot be written: No such file or directory");
}

class EveryForm : public testing::TestWithParam<const char*> {
 protected:
    raks::test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / (std::string("film") + GetParam());
};

TEST_P(EveryForm, the_same_input_gives_the_same_bytes) {
    const auto again = folder_ / (std::string("again") + GetParam());
    ASSERT_TRUE(write_noise(path_, 20));
    ASSERT_TRUE(write_noise(again, 20));
    if (std::filesystem::is_directory(path_)) {
        EXPECT_EQ(read_file(path_ / "000020.png").value(), read_file(again / "000020.png").value());
    } else {
        EXPECT_EQ(read_file(path_).value(), read_file(again).value());
    }
}

TEST_P(EveryForm, nothing_is_left_of_a_film_that_is_not_finished) {
    {
        auto film = VideoWriter::create(path_, kSmall);
        ASSERT_TRUE(film) << film.error().message;
        for (int i = 0; i < 60; ++i) {
            ASSERT_TRUE((*film)->add_picture(plain_picture(kWidth, kHeight, 1, 2, 3)));
        }
        EXPECT_FALSE(std::filesystem::exists(path_));
    }
    EXPECT_TRUE(folder_.is_empty());
}

TEST_P(EveryForm, stopped_after_one_picture_it_keeps_that_picture) {
    ASSERT_TRUE(write_noise(path_, 1));
    EXPECT_TRUE(std::filesystem::exists(path_));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1)
        << "no part is left";
    if (!std::filesystem::is_directory(path_)) {
        EXPECT_EQ(decoded_grey(path_).size(), std::size_t{kWidth} * kHeight);
    }
}

TEST_P(EveryForm, a_film_that_is_stopped_lies_beside_what_has_its_name) {
    const auto stopped = folder_ / (std::string("film.stopped") + GetParam());
    const bool is_folder = *GetParam() == '\0';
    if (!is_folder) {  // a folder that holds files is never written over
        ASSERT_TRUE(write_file(path_, "an older film"));
    }
    auto film = VideoWriter::create(path_, kSmall);
    ASSERT_TRUE(film) << film.error().message;
    for (std::uint64_t i = 0; i < 3; ++i) {
        ASSERT_TRUE((*film)->add_picture(noise_picture(kWidth, kHeight, i)));
    }
    EXPECT_EQ((*film)->finish_stopped().value(), stopped);
    film->reset();
    if (!is_folder) {
        EXPECT_EQ(read_file(path_).value(), "an older film");
        EXPECT_EQ(decoded_grey(stopped).size(), std::size_t{3} * kWidth * kHeight);
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}),
              is_folder ? 1 : 2)
        << "no part is left";
}

TEST_P(EveryForm, a_film_without_pictures_is_refused) {
    auto film = VideoWriter::create(path_, kSmall);
    ASSERT_TRUE(film);
    ASSERT_TRUE((*film)->add_sound(std::vector<float>(4800)));
    const auto finished = (*film)->finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().message,
              path_.string() + ": no picture was drawn; nothing is written");
    film->reset();
    EXPECT_TRUE(folder_.is_empty());
}

TEST_P(EveryForm, a_picture_of_another_size_is_refused) {
    auto film = VideoWriter::create(path_, kSmall);
    ASSERT_TRUE(film);
    const auto added = (*film)->add_picture(Rgba(100));
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().message,
              path_.string() + ": a picture of 160x96 does not have 100 bytes");
}

/// As a full disk: the same error path, and the limit belongs to this process alone.
class FileSizeLimit {
 public:
    explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{.rlim_cur = bytes, .rlim_max = old_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
    rlimit old_{};
    void (*old_handler_)(int);
};

TEST_P(EveryForm, a_full_disk_ends_in_one_line_and_leaves_what_plays) {
    // Large enough that one picture as PNG is larger than the largest limit.
    constexpr int kWide = 448;
    constexpr int kHigh = 256;
    // Met by the header, by the first pictures, and far into the film.
    for (const rlim_t limit : {rlim_t{0}, rlim_t{100}, rlim_t{20'000}, rlim_t{300'000}}) {
        std::optional<FileSizeLimit> full(limit);
        const auto written = write_noise(path_, 120, {.width = kWide, .height = kHigh});
        ASSERT_FALSE(written) << "limit " << limit;
        const std::string& line = written.error().message;
        EXPECT_NE(line.find("cannot be written: File too large"), std::string::npos) << line;
        EXPECT_EQ(line.rfind(path_.string(), 0), 0U) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        full.reset();
        const auto stopped = folder_ / (std::string("film.stopped") + GetParam());
        const bool is_kept = std::filesystem::exists(stopped);
        EXPECT_EQ(
            line.find("; the film up to there lies in " + stopped.string()) != std::string::npos,
            is_kept)
            << line;
        if (is_kept) {
            EXPECT_GE(decoded_grey(stopped).size(), std::size_t{kWide} * kHigh)
                << "limit " << limit;
            std::filesystem::remove(stopped);
        }
        EXPECT_TRUE(folder_.is_empty()) << "limit " << limit;
    }
}

INSTANTIATE_TEST_SUITE_P(forms,
                         EveryForm,
                         testing::Values(".mp4", ".mkv", ".webm", ".avi", ""),
                         [](const auto& test_case) {
                             return *test_case.param == '\0'
                                        ? std::string("folder")
                                        : std::string(test_case.param).substr(1);
                         });

TEST(VideoWriter, a_disk_that_fills_up_midway_leaves_what_plays_beside_the_old_film) {
    constexpr int kPictures = 200;
    for (const std::string form : {".mp4", ".mkv", ".webm", ".avi"}) {
        SCOPED_TRACE(form);
        const raks::test::TemporaryFolder folder;
        const auto path = folder / ("film" + form);
        ASSERT_TRUE(write_noise(path, kPictures));
        const std::string older = read_file(path).value();
        {
            const FileSizeLimit full(older.size() / 2);
            EXPECT_FALSE(write_noise(path, kPictures));
        }
        EXPECT_EQ(read_file(path).value(), older);
        const std::size_t pictures =
            decoded_grey(folder / ("film.stopped" + form)).size() / (kWidth * kHeight);
        EXPECT_GE(pictures, 60U);
        EXPECT_LT(pictures, std::size_t{kPictures});
    }
}

TEST(VideoWriter, a_small_film_that_only_the_end_does_not_fit_is_refused_at_the_end) {
    const raks::test::TemporaryFolder folder;
    const FileSizeLimit full(1500);  // passes header and pictures, not the table at the end
    auto film =
        VideoWriter::create(folder / "a.mp4", {.width = 64, .height = 64, .audio_channels = 0});
    ASSERT_TRUE(film) << film.error().message;
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE((*film)->add_picture(plain_picture(64, 64, 50, 50, 50)));
    }
    EXPECT_FALSE((*film)->finish());
    film->reset();
    EXPECT_TRUE(folder.is_empty());
}

struct Colour {
    int r;
    int g;
    int b;
};

TEST(VideoWriter, colours_come_back_from_every_form) {
    const raks::test::TemporaryFolder folder;
    constexpr std::array kColours = {Colour{0, 0, 0},
                                     Colour{255, 255, 255},
                                     Colour{200, 30, 40},
                                     Colour{30, 180, 60},
                                     Colour{20, 60, 220},
                                     Colour{128, 128, 128}};
    for (const char* const name : {"c.mp4", "c.mkv", "c.webm", "c.avi"}) {
        auto film = VideoWriter::create(folder / name,
                                        {.width = 64, .height = 64, .quality = VideoQuality::high});
        ASSERT_TRUE(film) << film.error().message;
        for (const Colour& c : kColours) {
            ASSERT_TRUE((*film)->add_picture(plain_picture(64,
                                                           64,
                                                           static_cast<std::uint8_t>(c.r),
                                                           static_cast<std::uint8_t>(c.g),
                                                           static_cast<std::uint8_t>(c.b))));
        }
        ASSERT_TRUE((*film)->finish());
        const std::string rgb = decoded_rgb(folder / name);
        ASSERT_EQ(rgb.size(), std::size_t{64} * 64 * 3 * kColours.size());
        for (std::size_t i = 0; i < kColours.size(); ++i) {
            const auto at = (i * 64 * 64 + 32 * 64 + 32) * 3;
            const auto value = [&](std::size_t c) {
                return static_cast<unsigned char>(rgb[at + c]);
            };
            // 4:2:0 in 8 bits rounds each of three steps by about 1; JPEG at scale 2 by some more.
            EXPECT_NEAR(value(0), kColours[i].r, 5) << name << " colour " << i;
            EXPECT_NEAR(value(1), kColours[i].g, 5) << name << " colour " << i;
            EXPECT_NEAR(value(2), kColours[i].b, 5) << name << " colour " << i;
        }
    }
}

TEST(VideoWriter, the_top_row_comes_first) {
    const raks::test::TemporaryFolder folder;
    Rgba picture = plain_picture(64, 64, 0, 0, 0);
    std::fill(picture.begin(), picture.begin() + 64 * 32 * 4, std::uint8_t{255});
    auto film = VideoWriter::create(folder / "top.mp4", {.width = 64, .height = 64});
    ASSERT_TRUE((*film)->add_picture(picture));
    ASSERT_TRUE((*film)->finish());
    const std::string grey = decoded_grey(folder / "top.mp4");
    EXPECT_GT(static_cast<unsigned char>(grey[64 * 10 + 32]), 200);
    EXPECT_LT(static_cast<unsigned char>(grey[64 * 50 + 32]), 50);
}

TEST(VideoWriter, an_mp4_says_that_it_is_bt709_h264_and_aac) {
    const raks::test::TemporaryFolder folder;
    ASSERT_TRUE(write_noise(folder / "a.mp4", 5));
    EXPECT_EQ(probe(folder / "a.mp4", "v:0", "codec_name"), "h264");
    EXPECT_EQ(probe(folder / "a.mp4", "v:0", "pix_fmt"), "yuv420p");
    EXPECT_EQ(probe(folder / "a.mp4", "v:0", "color_space"), "bt709");
    EXPECT_EQ(probe(folder / "a.mp4", "v:0", "color_range"), "tv");
    EXPECT_EQ(probe(folder / "a.mp4", "a:0", "codec_name"), "aac");
    ASSERT_TRUE(write_noise(folder / "c.mkv", 5));
    EXPECT_EQ(probe(folder / "c.mkv", "v:0", "codec_name"), "h264");
    EXPECT_EQ(probe(folder / "c.mkv", "a:0", "codec_name"), "opus");
    ASSERT_TRUE(write_noise(folder / "d.webm", 5));
    EXPECT_EQ(probe(folder / "d.webm", "v:0", "codec_name"), "vp9");
    EXPECT_EQ(probe(folder / "d.webm", "v:0", "color_space"), "bt709");
    EXPECT_EQ(probe(folder / "d.webm", "a:0", "codec_name"), "opus");
    ASSERT_TRUE(write_noise(folder / "b.avi", 5));
    EXPECT_EQ(probe(folder / "b.avi", "v:0", "codec_name"), "mjpeg");
    EXPECT_EQ(probe(folder / "b.avi", "a:0", "codec_name"), "pcm_s16le");
}

TEST(VideoWriter, a_finished_mp4_is_plain_and_its_table_has_every_picture) {
    const raks::test::TemporaryFolder folder;
    ASSERT_TRUE(write_noise(folder / "a.mp4", 100));
    const std::string film = read_file(folder / "a.mp4").value();
    EXPECT_EQ(film.find("moof"), std::string::npos) << "no fragments";
    EXPECT_NE(film.find("moov"), std::string::npos);
    EXPECT_EQ(probe(folder / "a.mp4", "v:0", "nb_frames"), "100");
}

/// Writes `pictures` pictures of noise into a film and dies without finishing it.
void write_and_die(const std::filesystem::path& path, int pictures) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto film = VideoWriter::create(path, kSmall);
        for (int i = 0; film && i < pictures; ++i) {
            static_cast<void>((*film)->add_sound(std::vector<float>(2 * 1600, 0.1F)));
            static_cast<void>((*film)->add_picture(
                noise_picture(kWidth, kHeight, static_cast<std::uint64_t>(i))));
        }
        std::raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(VideoWriter, what_a_killed_writer_leaves_plays) {
    for (const char* const name : {"a.mp4", "a.mkv", "a.webm", "a.avi"}) {
        const raks::test::TemporaryFolder folder;
        ASSERT_NO_FATAL_FAILURE(write_and_die(folder / name, 300));
        EXPECT_FALSE(std::filesystem::exists(folder / name));
        const auto part = std::filesystem::directory_iterator(folder.path())->path();
        const std::size_t pictures = decoded_grey(part).size() / (kWidth * kHeight);
        // 10 s were written; encoders look up to 2 s ahead, and a piece may be begun.
        EXPECT_GE(pictures, 200U) << name;
        EXPECT_LE(pictures, 300U) << name;
        EXPECT_GE(decoded_sound(part).size(), 200U * 1600) << name;
    }
}

TEST(VideoWriter, a_check_leaves_nothing_and_touches_nothing) {
    const raks::test::TemporaryFolder folder;
    for (const char* const name : {"a.mp4", "a.webm", "pictures"}) {
        EXPECT_TRUE(VideoWriter::check(folder / name, kSmall)) << name;
        EXPECT_TRUE(folder.is_empty());
    }
    ASSERT_TRUE(write_noise(folder / "a.avi", 2));
    const std::string first = read_file(folder / "a.avi").value();
    EXPECT_TRUE(VideoWriter::check(folder / "a.avi", kSmall));
    EXPECT_EQ(read_file(folder / "a.avi").value(), first);
}

TEST(VideoWriter, sound_of_a_rate_that_the_codec_lacks_is_resampled) {
    const raks::test::TemporaryFolder folder;
    for (const auto& [name, rate] : {std::pair{"a.webm", 44'100}, std::pair{"b.mp4", 192'000}}) {
        auto film = VideoWriter::create(
            folder / name, {.width = 64, .height = 64, .audio_rate = rate, .audio_channels = 1});
        ASSERT_TRUE(film) << film.error().message;
        std::vector<float> tone(static_cast<std::size_t>(2 * rate));
        for (std::size_t i = 0; i < tone.size(); ++i) {
            tone[i] = 0.5F * static_cast<float>(
                                 std::sin(2.0 * M_PI * 440.0 * static_cast<double>(i) / rate));
        }
        ASSERT_TRUE((*film)->add_sound(tone));
        for (int i = 0; i < 60; ++i) {
            ASSERT_TRUE((*film)->add_picture(plain_picture(64, 64, 9, 9, 9)));
        }
        ASSERT_TRUE((*film)->finish());
        EXPECT_EQ(probe(folder / name, "a:0", "sample_rate"), "48000");
        const std::vector<float> heard = decoded_sound(folder / name);
        EXPECT_NEAR(static_cast<double>(heard.size()), 96'000.0, 1024.0) << name;
        int crossings = 0;
        for (std::size_t i = 24'001; i < 72'000; ++i) {
            crossings += heard[i - 1] < 0.0F && heard[i] >= 0.0F ? 1 : 0;
        }
        EXPECT_NEAR(crossings, 440, 1) << name;
    }
}

TEST(VideoWriter, sound_that_is_no_number_or_too_loud_is_mended) {
    const raks::test::TemporaryFolder folder;
    auto film =
        VideoWriter::create(folder / "a.avi", {.width = 64, .height = 64, .audio_channels = 1});
    const std::vector<float> sound = {std::nanf(""), 7.0F, -7.0F, INFINITY, 0.5F};
    ASSERT_TRUE((*film)->add_sound(sound));
    ASSERT_TRUE((*film)->add_picture(plain_picture(64, 64, 0, 0, 0)));
    ASSERT_TRUE((*film)->finish());
    const std::vector<float> read = decoded_sound(folder / "a.avi");
    ASSERT_EQ(read.size(), 1600U);
    EXPECT_EQ(read[0], 0.0F);
    EXPECT_NEAR(read[1], 1.0F, 1e-4);
    EXPECT_NEAR(read[2], -1.0F, 1e-4);
    EXPECT_NEAR(read[3], 1.0F, 1e-4);
    EXPECT_NEAR(read[4], 0.5F, 1e-4);
    EXPECT_EQ(read[5], 0.0F);
}

TEST(VideoWriter, a_folder_that_holds_files_is_left_alone) {
    const raks::test::TemporaryFolder folder;
    ASSERT_TRUE(write_noise(folder / "pictures", 3));
    const auto again = write_noise(folder / "pictures/", 1);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().message,
              (folder / "pictures").string() +
                  ": exists already and is not an empty folder; name another");
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/000003.png"));
}

TEST(VideoWriter, a_film_that_exists_is_replaced_only_when_the_new_one_is_complete) {
    const raks::test::TemporaryFolder folder;
    ASSERT_TRUE(write_noise(folder / "a.avi", 2));
    const std::string first = read_file(folder / "a.avi").value();
    {
        auto film = VideoWriter::create(folder / "a.avi", kSmall);
        ASSERT_TRUE((*film)->add_picture(plain_picture(kWidth, kHeight, 1, 1, 1)));
        EXPECT_EQ(read_file(folder / "a.avi").value(), first);
    }
    EXPECT_EQ(read_file(folder / "a.avi").value(), first);
    ASSERT_TRUE(write_noise(folder / "a.avi", 4));
    EXPECT_NE(read_file(folder / "a.avi").value(), first);
}

}  // namespace
}  // namespace raks::render
