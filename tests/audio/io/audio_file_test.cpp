#include "audio/io/audio_file.hpp"
#include "audio/io/wav_writer.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "audio/io/decoders.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/audio/io/sound_files.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;
using test::drums;
using test::read_rest;
using ::testing::HasSubstr;

using AudioFileTest = test::SoundFilesTest;

struct Format {
    const char* name;
    const char* options;
    int rate;          ///< of the decoded file
    bool is_exact;     ///< 16-bit samples come back as they were
    int extra_frames;  ///< most that the coder's padding may add at the end
    int most_shift;    ///< frames, of the decoded against the original
};
constexpr Format kFormats[] = {
    {"a.wav", "", 44'100, true, 0, 0},
    {"a.flac", "", 44'100, true, 0, 0},
    {"a.aiff", "", 44'100, true, 0, 0},
    {"a.ogg", "-c:a libvorbis", 44'100, false, 0, 0},
    {"a.opus", "-ar 48000 -b:a 160k", 48'000, false, 0, 0},
    {"a.mp3", "-b:a 192k", 44'100, false, 0, 0},
    {"vbr.mp3", "-q:a 3", 44'100, false, 0, 0},
    {"a.m4a", "-b:a 192k", 44'100, false, 1024, 0},
    {"a.aac", "-b:a 192k", 44'100, false, 2048, 1024},  // ADTS cannot say its encoder's delay
    {"a.webm", "-c:a libopus -ar 48000 -b:a 160k", 48'000, false, 960, 0},
    {"vorbis.webm", "-c:a libvorbis", 44'100, false, 1024, 0},
    {"a.mkv", "-c:a aac -b:a 192k", 44'100, false, 2048, 1024},
    {"a.wma", "-b:a 192k", 44'100, false, 4096, 4096},
};

/// The lag (frames) at which `b` is most like `a`, left channels.
int best_lag(const std::vector<float>& a, const std::vector<float>& b, int reach) {
    int best = 0;
    double best_sum = 0.0;
    for (int lag = -reach; lag <= reach; ++lag) {
        double sum = 0.0;
        for (std::size_t i = 30'000; i < 45'000; ++i) {
            const auto j = static_cast<std::size_t>(static_cast<int>(i) + lag);
            sum += static_cast<double>(a[2 * i]) * static_cast<double>(b[2 * j]);
        }
        if (sum > best_sum) {
            best_sum = sum;
            best = lag;
        }
    }
    return best;
}

TEST_F(AudioFileTest, every_format_is_read_whole_and_in_its_place) {
    for (const Format& format : kFormats) {
        SCOPED_TRACE(format.name);
        const auto music = drums(3.0, format.rate, 2);
        ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
        const auto file = encode(folder_ / "in.wav", format.name, format.options);
        auto reader = open_audio_file(file);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_EQ((*reader)->info().rate.hertz(), format.rate);
        EXPECT_EQ((*reader)->info().channels, 2);
        EXPECT_NEAR((*reader)->info().claimed_seconds.value(), 3.0, 0.2);
        const auto samples = read_rest(**reader);
        const auto frames = static_cast<std::int64_t>(samples.size() / 2);
        EXPECT_GE(frames, music.frames() - format.most_shift);
        EXPECT_LE(frames, music.frames() + format.extra_frames + format.most_shift);
        EXPECT_EQ((*reader)->warning(), "");
        EXPECT_LE(std::abs(best_lag(music.samples, samples, format.most_shift + 20)),
                  format.most_shift);
        if (format.is_exact) {
            for (std::size_t i = 0; i < samples.size(); ++i) {
                ASSERT_NEAR(samples[i], music.samples[i], 1.0F / 32'000.0F);
            }
        }
    }
}

TEST_F(AudioFileTest, a_seek_goes_on_exactly_where_a_straight_read_would_be) {
    for (const Format& format : kFormats) {
        SCOPED_TRACE(format.name);
        const auto music = drums(4.0, format.rate, 2);
        ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
        auto reader = open_audio_file(encode(folder_ / "in.wav", format.name, format.options));
        ASSERT_TRUE(reader) << reader.error().message;
        const auto whole = read_rest(**reader);
        std::vector<float> part(2 * 2000);
        for (const std::int64_t frame : {0L, 1L, 5'000L, 123'456L, 44'100L, 100'000L, 20'000L}) {
            ASSERT_TRUE((*reader)->seek(frame));
            ASSERT_EQ((*reader)->read(part), 2000U) << frame;
            double difference = 0.0;
            double energy = 1e-9;
            for (std::size_t i = 0; i < part.size(); ++i) {
                const double there =
                    static_cast<double>(whole[2 * static_cast<std::size_t>(frame) + i]);
                difference += std::pow(static_cast<double>(part[i]) - there, 2);
                energy += there * there;
            }
            EXPECT_LT(difference, 1e-3 * energy + 1e-6) << frame;
        }
        ASSERT_TRUE((*reader)->seek(10'000'000));
        EXPECT_EQ((*reader)->read(part), 0U);
        ASSERT_TRUE((*reader)->seek(0));
        EXPECT_EQ((*reader)->read(part), 2000U);
    }
}

// libsndfile finds a page of Vorbis wrongly from some places.
TEST_F(AudioFileTest, a_seek_in_vorbis_is_exact_from_anywhere) {
    const auto music = drums(4.0, 44'100, 2);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
    const auto file = encode(folder_ / "in.wav", "a.ogg", "-c:a libvorbis");
    const auto window = FileWindow::adopt(::open(file.c_str(), O_RDONLY | O_CLOEXEC), "a.ogg");
    ASSERT_TRUE(window);
    const auto reader = open_by_decoders("a.ogg", *window);
    ASSERT_TRUE(reader) << reader.error().message;
    const auto whole = read_rest(**reader);
    std::vector<float> block(2 * 8192);
    std::vector<float> part(2 * 2000);
    for (const std::int64_t target : {110'000L, 123'456L, 150'000L, 170'000L}) {
        for (int blocks = 0; blocks < 12; ++blocks) {
            ASSERT_TRUE((*reader)->seek(0));
            for (int i = 0; i < blocks; ++i) {
                static_cast<void>((*reader)->read(block));
            }
            ASSERT_TRUE((*reader)->seek(target));
            ASSERT_EQ((*reader)->read(part), 2000U);
            const float* const there = whole.data() + 2 * target;
            EXPECT_TRUE(
                std::equal(part.begin(),
                           part.end(),
                           there,
                           [](float one, float other) { return std::abs(one - other) < 1e-3F; }))
                << target << " from " << blocks;
        }
    }
}

TEST_F(AudioFileTest, any_partition_of_the_reads_gives_the_same_samples) {
    const auto music = drums(1.0, 44'100, 2);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
    for (const char* name : {"a.mp3", "a.m4a", "a.ogg"}) {
        const auto file = encode(folder_ / "in.wav", name);
        auto first = open_audio_file(file);
        auto second = open_audio_file(file);
        ASSERT_TRUE(first && second);
        EXPECT_EQ(read_rest(**first, 4096), read_rest(**second, 137)) << name;
    }
}

TEST_F(AudioFileTest, the_sound_of_a_video_is_read) {
    const auto music = drums(1.0, 48'000, 2);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
    const auto file = encode(
        folder_ / "in.wav", "v.mp4", "-f lavfi -i color=s=64x64:d=1 -map 1:v -map 0:a -c:v mpeg4");
    const auto mono = read_all_mono(file);
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_GE(mono->samples.size(), 48'000U);
    const auto silent = encode(
        folder_ / "in.wav", "silent.mp4", "-f lavfi -i color=s=64x64:d=1 -map 1:v -c:v mpeg4");
    EXPECT_EQ(open_audio_file(silent).error().message, silent.string() + ": has no sound track");
}

TEST_F(AudioFileTest, each_bad_file_gets_one_clear_line) {
    const auto expect_error = [this](const std::string& name, const std::string& text) {
        const auto reader = open_audio_file(folder_ / name);
        ASSERT_FALSE(reader) << name;
        EXPECT_EQ(reader.error().message, (folder_ / name).string() + ": " + text);
    };
    expect_error("none.mp3", "cannot be opened: No such file or directory");
    ASSERT_TRUE(write_file(folder_ / "empty.mp3", ""));
    expect_error("empty.mp3", "is empty");
    fs::create_directory(folder_ / "folder.wav");
    expect_error("folder.wav", "is a folder, not a file");
    ASSERT_EQ(mkfifo((folder_ / "pipe.wav").c_str(), 0600), 0);
    expect_error("pipe.wav", "is not a plain file; copy what it holds into one");
    ASSERT_TRUE(write_file(folder_ / "text.wav", std::string(5000, 'x') + " is no music\n"));
    expect_error("text.wav", "is not audio that can be read");
    ASSERT_TRUE(write_file(folder_ / "list.m3u8",
                           "#EXTM3U\n#EXTINF:1,\nfile:///etc/passwd\n#EXT-X-ENDLIST\n"));
    expect_error("list.m3u8", "is not audio that can be read");
}

TEST_F(AudioFileTest, a_head_with_an_impossible_rate_is_refused) {
    const auto music = drums(0.1, 48'000, 1);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 1, music.rate));
    for (const std::uint32_t rate : {0U, 500U, 10'000'000U, 0xFFFFFFFFU}) {
        std::string bytes = read_file(folder_ / "in.wav").value();
        std::memcpy(bytes.data() + 24, &rate, 4);
        ASSERT_TRUE(write_file(folder_ / "bad.wav", bytes));
        const auto reader = open_audio_file(folder_ / "bad.wav");
        ASSERT_FALSE(reader) << rate;
        EXPECT_THAT(reader.error().message, HasSubstr("bad.wav: "));
        EXPECT_THAT(reader.error().message, ::testing::Not(HasSubstr("nternal error")));
        if (rate == 500U) {
            EXPECT_THAT(reader.error().message,
                        HasSubstr("has a sample rate of 500 Hz, must be 1000 to 3000000"));
        }
    }
}

TEST_F(AudioFileTest, a_truncated_file_plays_what_is_there_and_says_so) {
    const auto music = drums(4.0, 44'100, 2);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
    for (const char* name : {"a.flac", "a.mp3", "a.aac", "a.mkv"}) {
        const std::string bytes = read_file(encode(folder_ / "in.wav", name)).value();
        ASSERT_TRUE(
            write_file(folder_ / "cut", std::string_view(bytes).substr(0, bytes.size() / 2)));
        ::testing::internal::CaptureStderr();
        const auto mono = read_all_mono(folder_ / "cut");
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name;
        ASSERT_TRUE(mono) << mono.error().message;
        EXPECT_GT(mono->samples.size(), 44'100U) << name;
        EXPECT_LT(mono->samples.size(), 3 * 44'100U) << name;
        if (std::string_view(name) != "a.aac") {  // ADTS does not say how long it should be
            EXPECT_THAT(mono->warning, HasSubstr("is damaged or cut off at ")) << name;
        }
    }
}

TEST_F(AudioFileTest, nan_and_loud_values_are_handed_on) {
    std::string bytes(
        "RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x03\0\x01\0\x40\x1f\0\0\0\x7d\0\0\x04\0\x20\0"
        "data\x0c\0\0\0",
        44);
    bytes[4] = 48;
    for (const float value : {0.5F, std::numeric_limits<float>::quiet_NaN(), 3.0F}) {
        const auto bits = std::bit_cast<std::array<char, 4>>(value);
        bytes.append(bits.data(), 4);
    }
    ASSERT_TRUE(write_file(folder_ / "nan.wav", bytes));
    const auto mono = read_all_mono(folder_ / "nan.wav");
    ASSERT_TRUE(mono) << mono.error().message;
    ASSERT_EQ(mono->samples.size(), 3U);
    EXPECT_EQ(mono->samples[0], 0.5F);
    EXPECT_TRUE(std::isnan(mono->samples[1]));
    EXPECT_EQ(mono->samples[2], 3.0F);
}

TEST_F(AudioFileTest, eight_channels_at_192_khz_and_one_at_8_khz_work) {
    const std::vector<float> wide(8 * 1000, 0.25F);
    ASSERT_TRUE(write_wav(folder_ / "w.wav", wide, 8, SampleRate(192'000)));
    const auto mono = read_all_mono(folder_ / "w.wav");
    ASSERT_TRUE(mono);
    EXPECT_EQ(mono->rate, SampleRate(192'000));
    ASSERT_EQ(mono->samples.size(), 1000U);
    EXPECT_NEAR(mono->samples[500], 0.25F, 1e-4F);
    const std::vector<float> narrow(800, -0.5F);
    ASSERT_TRUE(write_wav(folder_ / "n.wav", narrow, 1, SampleRate(8'000)));
    EXPECT_EQ(read_all_mono(folder_ / "n.wav")->samples, narrow);
}

TEST_F(AudioFileTest, a_file_longer_than_the_limit_is_refused_not_cut) {
    const std::vector<float> zeros(8'000 * 3, 0.0F);
    ASSERT_TRUE(write_wav(folder_ / "x.wav", zeros, 1, SampleRate(8'000)));
    EXPECT_EQ(read_all_mono(folder_ / "x.wav", 2.0).error().message,
              (folder_ / "x.wav").string() +
                  ": is longer than 2 s, the limit for reading a whole "
                  "file");
    EXPECT_TRUE(read_all_mono(folder_ / "x.wav", 3.0));
}

TEST_F(AudioFileTest, ten_hours_are_read_in_bounded_memory) {
    constexpr std::int64_t kFrames = 10LL * 3600 * 8'000;
    const std::vector<float> zeros(8'000, 0.0F);
    ASSERT_TRUE(write_wav(folder_ / "long.wav", zeros, 1, SampleRate(8'000)));
    std::string head = read_file(folder_ / "long.wav")->substr(0, 44);
    const auto data_bytes = static_cast<std::uint32_t>(2 * kFrames);
    const std::uint32_t riff_bytes = data_bytes + 36;
    std::memcpy(head.data() + 4, &riff_bytes, 4);
    std::memcpy(head.data() + 40, &data_bytes, 4);
    ASSERT_TRUE(write_file(folder_ / "long.wav", head));
    fs::resize_file(folder_ / "long.wav", 44 + 2 * kFrames);  // a hole: takes no disk
    rusage before{};
    getrusage(RUSAGE_SELF, &before);
    auto reader = open_audio_file(folder_ / "long.wav").value();
    std::vector<float> chunk(16'384);
    std::int64_t frames = 0;
    while (const std::size_t got = reader->read(chunk)) {
        frames += static_cast<std::int64_t>(got);
    }
    EXPECT_EQ(frames, kFrames);
    rusage after{};
    getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 4L * 1024);  // KiB
    EXPECT_THAT(read_all_mono(folder_ / "long.wav").error().message, HasSubstr("is longer than"));
}

TEST_F(AudioFileTest, a_full_disk_leaves_no_wav) {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit saved{};
    getrlimit(RLIMIT_FSIZE, &saved);
    rlimit small = saved;
    small.rlim_cur = 10'000;
    setrlimit(RLIMIT_FSIZE, &small);
    const auto result =
        write_wav(folder_ / "x.wav", std::vector<float>(100'000, 0.1F), 1, SampleRate(48'000));
    setrlimit(RLIMIT_FSIZE, &saved);
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("x.wav: cannot be written"));
    EXPECT_TRUE(folder_.is_empty());
}

}  // namespace
}  // namespace raks::audio
