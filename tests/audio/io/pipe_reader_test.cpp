// Sound that comes through a pipe: real FIFOs, written by a thread as another program would.
#include "audio/io/pipe_reader.hpp"
#include "audio/io/wav_writer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>
#include <utility>

#include "audio/io/file_player.hpp"
#include "base/file.hpp"
#include "tests/audio/io/sound_files.hpp"
#include "tests/support/mangled.hpp"

namespace raks::audio {
namespace {

/// Writes bytes into a FIFO from a thread of its own, and then closes it or keeps it open.
class Writer {
 public:
    enum class End { closes, stays_open };
    Writer(const std::filesystem::path& pipe, std::string bytes, End end = End::closes)
        : bytes_(std::move(bytes)), thread_([=, this] { run(pipe, end); }) {}
    ~Writer() {
        is_done_.store(true);
        thread_.join();
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
    }

 private:
    void run(const std::filesystem::path& pipe, End end) {
        std::signal(SIGPIPE, SIG_IGN);
        descriptor_ = ::open(pipe.c_str(), O_WRONLY);
        std::size_t at = 0;
        while (at < bytes_.size() && !is_done_.load()) {
            const ssize_t wrote = ::write(descriptor_, bytes_.data() + at, bytes_.size() - at);
            if (wrote <= 0) {
                break;
            }
            at += static_cast<std::size_t>(wrote);
        }
        if (end == End::closes) {
            ::close(descriptor_);
            descriptor_ = -1;
        }
    }

    std::string bytes_;
    int descriptor_ = -1;
    std::atomic<bool> is_done_{false};
    std::thread thread_;
};

class Pipes : public test::SoundFilesTest {
 protected:
    Pipes() { EXPECT_EQ(mkfifo(pipe_.c_str(), 0600), 0); }

    std::filesystem::path make_wav(double seconds) {
        const auto music = test::drums(seconds, 44'100, 2);
        EXPECT_TRUE(write_wav(folder_ / "a.wav", music.samples, 2, music.rate));
        return folder_ / "a.wav";
    }
    /// The error of opening a pipe with these bytes in it.
    std::string error_of(const std::string& bytes) {
        const Writer writer(pipe_, bytes);
        const auto reader = PipeReader::open(pipe_, patient_);
        return reader ? std::string("none") : reader.error().message;
    }

    const std::filesystem::path pipe_ = folder_ / "pipe";
    const PipeOptions quick_{.longest_wait = std::chrono::milliseconds(300)};
    // For writers that come, however busy the machine is.
    const PipeOptions patient_{.longest_wait = std::chrono::minutes(1)};
};

/// The lag of at most `most` frames at which two signals are most alike, and how alike.
double best_correlation(const std::vector<float>& a, const std::vector<float>& b, int most) {
    double best = 0.0;
    for (int lag = -most; lag <= most; ++lag) {
        double ab = 0.0;
        double aa = 0.0;
        double bb = 0.0;
        for (std::size_t i = 4000; i + 8000 < std::min(a.size(), b.size()); i += 2) {
            const auto x = static_cast<double>(a[i]);
            const auto y = static_cast<double>(b[i + static_cast<std::size_t>(2 * (lag + most)) -
                                                 static_cast<std::size_t>(2 * most)]);
            ab += x * y;
            aa += x * x;
            bb += y * y;
        }
        best = std::max(best, ab / std::sqrt(aa * bb + 1e-12));
    }
    return best;
}

TEST_F(Pipes, a_wav_comes_out_as_from_its_file) {
    const auto wav = make_wav(3.0);
    const Writer writer(pipe_, read_file(wav).value());
    auto reader = PipeReader::open(pipe_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ((*reader)->info().rate.hertz(), 44'100);
    EXPECT_EQ((*reader)->info().channels, 2);
    EXPECT_EQ((*reader)->info().claimed_seconds, std::nullopt);
    auto file = open_audio_file(wav).value();
    EXPECT_EQ(test::read_rest(**reader, 777), test::read_rest(*file));
    EXPECT_EQ((*reader)->warning(), "");
}

TEST_F(Pipes, flac_ogg_and_mp3_come_out_whole) {
    const auto wav = make_wav(3.0);
    const auto original = test::read_rest(*open_audio_file(wav).value());
    for (const char* const name : {"a.flac", "a.ogg", "a.mp3"}) {
        const Writer writer(pipe_, read_file(encode(wav, name)).value());
        auto reader = PipeReader::open(pipe_);
        ASSERT_TRUE(reader) << name << reader.error().message;
        const auto heard = test::read_rest(**reader);
        EXPECT_NEAR(static_cast<double>(heard.size()) / 2, 3.0 * 44'100, 3000) << name;
        EXPECT_GT(best_correlation(original, heard, 1200), 0.97) << name;
    }
}

TEST_F(Pipes, a_wav_whose_head_gives_no_length_is_read_to_the_end) {
    const auto wav = make_wav(2.0);
    std::string bytes = read_file(wav).value();
    const std::size_t data = bytes.find("data");
    for (const std::string& length : {std::string(4, '\0'), std::string(4, '\xff')}) {
        bytes.replace(4, 4, length);
        bytes.replace(data + 4, 4, length);
        const Writer writer(pipe_, bytes);
        auto reader = PipeReader::open(pipe_);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_EQ(test::read_rest(**reader).size(), 2U * 2 * 44'100);
    }
}

TEST_F(Pipes, a_pipe_that_nobody_writes_is_said_and_not_waited_for) {
    const auto reader = PipeReader::open(pipe_, quick_);
    ASSERT_FALSE(reader);
    EXPECT_EQ(reader.error().message,
              pipe_.string() + ": nobody writes to this pipe; start the program that does first");
}

TEST_F(Pipes, a_head_that_stops_or_ends_is_said) {
    const std::string wav = read_file(make_wav(1.0)).value();
    {
        const Writer writer(pipe_, wav.substr(0, 20), Writer::End::stays_open);
        const auto stopped = PipeReader::open(pipe_, quick_);
        ASSERT_FALSE(stopped);
        EXPECT_EQ(
            stopped.error().message,
            pipe_.string() +
                ": stopped in the middle of its header; start the program that writes it again");
    }
    const std::string no_sound =
        pipe_.string() +
        ": is not sound that can be read from a pipe (WAV, FLAC, Ogg or MP3), "
        "or ends in the middle of its header";
    EXPECT_EQ(error_of(wav.substr(0, 20)), no_sound);
    EXPECT_EQ(error_of(std::string(300'000, 'x')), no_sound);
    EXPECT_EQ(error_of(""), pipe_.string() + ": is empty");
}

TEST_F(Pipes, whoever_waits_for_the_head_can_give_up) {
    bool was_asked = false;
    const auto reader =
        PipeReader::open(pipe_, {.longest_wait = std::chrono::hours(1), .is_stop_requested = [&] {
                                     return std::exchange(was_asked, true);
                                 }});
    EXPECT_FALSE(reader);
}

TEST_F(Pipes, a_reader_that_waits_for_the_writer_can_be_stopped) {
    const Writer writer(pipe_, read_file(make_wav(1.0)).value(), Writer::End::stays_open);
    auto player = FilePlayer::start(PipeReader::open(pipe_).value(), pipe_);
    EXPECT_FALSE(player->can_seek());
    player->wait_until_ready(40'000);
    std::vector<float> block(2 * 1000);
    EXPECT_EQ(player->pull(block).frames, 1000U);
    player->seek(0, 0.5);
    const PulledAudio pulled = player->pull(block);
    EXPECT_EQ(pulled.position, 1000) << "there is no going ahead";
    EXPECT_FALSE(player->is_seeking());
    player->stop();  // would hang
}

TEST_F(Pipes, a_player_plays_a_pipe_to_its_end) {
    const Writer writer(pipe_, read_file(make_wav(0.5)).value());
    auto player = FilePlayer::start(PipeReader::open(pipe_).value(), pipe_);
    std::size_t frames = 0;
    std::vector<float> block(2 * 512);
    for (;;) {
        player->wait_until_ready(512);
        const PulledAudio pulled = player->pull(block);
        frames += pulled.frames;
        if (pulled.is_ended) {
            break;
        }
    }
    EXPECT_EQ(frames, 22'050U);
}

TEST_F(Pipes, there_is_no_going_back) {
    const Writer writer(pipe_, read_file(make_wav(0.5)).value());
    auto reader = PipeReader::open(pipe_).value();
    std::vector<float> block(200);
    ASSERT_EQ(reader->read(block), 100U);
    EXPECT_TRUE(reader->seek(100));
    EXPECT_EQ(reader->seek(0).error().message,
              pipe_.string() + ": comes through a pipe, in which there is no going back or ahead");
}

TEST_F(Pipes, cut_and_damaged_sound_ends_and_hangs_nothing) {
    const auto wav = make_wav(0.3);
    for (const char* const name : {"a.wav", "a.flac", "a.ogg", "a.mp3"}) {
        const std::string bytes =
            read_file(name == std::string("a.wav") ? wav : encode(wav, name)).value();
        const auto read_all = [&](const std::string& changed) {
            const Writer writer(pipe_, changed);
            auto reader = PipeReader::open(pipe_, quick_);
            if (reader) {
                EXPECT_LT(test::read_rest(**reader).size(), 20'000'000U);
            } else {
                EXPECT_EQ(reader.error().message.find('\n'), std::string::npos);
            }
        };
        for (std::size_t length = 1; length < 120; length += 1 + length / 8) {
            read_all(bytes.substr(0, length));
        }
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            read_all(raks::test::mangled(bytes, {.seed = seed, .bytes = 4, .reach = 400}));
        }
    }
}

}  // namespace
}  // namespace raks::audio
