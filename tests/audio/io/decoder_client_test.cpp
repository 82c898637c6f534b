// Files are decoded by another program: the same samples, and nothing that it does harms this one.
#include "audio/io/decoder_client.hpp"
#include "audio/io/wav_writer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/decoders.hpp"
#include "audio/io/file_player.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/audio/io/sound_files.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

/// Those that wait for a file or have one.
std::vector<pid_t> decoders() {
    std::vector<pid_t> found = raks::test::children_of(::getpid());
    std::erase_if(found, [](pid_t pid) {
        const auto name = read_file("/proc/" + std::to_string(pid) + "/comm");
        return !name || *name != std::string(kDecoderName) + "\n";
    });
    return found;
}

std::size_t count_of(const char* folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

class Decoders : public ::testing::Test {
 protected:
    /// Six seconds of stereo noise as WAV.
    [[nodiscard]] fs::path noise() const {
        const fs::path path = folder_.path() / "noise.wav";
        std::vector<float> samples(2 * 6 * 48'000);
        std::uint32_t seed = 1;
        for (float& sample : samples) {
            seed = seed * 1'664'525U + 1'013'904'223U;
            sample = static_cast<float>(seed >> 8U) / 33'554'432.0F - 0.25F;
        }
        EXPECT_TRUE(write_wav(path, samples, 2, SampleRate(48'000)));
        return path;
    }

    raks::test::TemporaryFolder folder_;
};

TEST_F(Decoders, give_the_same_samples_as_in_this_process_also_after_seeks) {
    const fs::path path = noise();
    const auto child = open_audio_file(path);
    const auto here = open_by_decoders(path, *FileWindow::open(path));
    ASSERT_TRUE(child && here);
    for (const std::int64_t frame : {0, 100'000, 7, 287'999, 400'000, 50'000}) {
        ASSERT_TRUE((*child)->seek(frame));
        ASSERT_TRUE((*here)->seek(frame));
        EXPECT_EQ(test::read_rest(**child), test::read_rest(**here)) << frame;
    }
}

TEST_F(Decoders, one_that_is_killed_ends_the_sound_with_one_line) {
    const fs::path path = noise();
    auto reader = open_audio_file(path);
    ASSERT_TRUE(reader);
    std::vector<float> block(2 * 4'800);
    ASSERT_EQ((*reader)->read(block), 4'800U);
    ASSERT_EQ(decoders().size(), 1U);
    ::kill(decoders().front(), SIGKILL);
    // What it had decoded ahead may still come.
    EXPECT_LT(test::read_rest(**reader).size(), 2U * 6 * 48'000 - block.size());
    EXPECT_NE(
        (*reader)->warning().find("noise.wav: its decoder ended too soon (killed by SIGKILL) at "),
        std::string::npos)
        << (*reader)->warning();
    EXPECT_FALSE((*reader)->seek(0));
    EXPECT_TRUE(decoders().empty());
}

TEST_F(Decoders, one_that_is_stopped_is_ended_and_said) {
    auto reader = open_audio_file(noise());
    ASSERT_TRUE(reader);
    ASSERT_EQ(decoders().size(), 1U);
    ::kill(decoders().front(), SIGSTOP);
    const auto sought = (*reader)->seek(0);
    ASSERT_FALSE(sought);
    EXPECT_NE(sought.error().message.find("its decoder did not answer in time and was ended"),
              std::string::npos)
        << sought.error().message;
    EXPECT_TRUE(decoders().empty());
}

TEST_F(Decoders, one_that_hangs_holds_nobody_back_who_wants_to_stop) {
    const fs::path path = noise();
    auto player = FilePlayer::start({path}, {});
    ASSERT_TRUE(player);
    (*player)->wait_until_ready(4'096);
    ASSERT_EQ(decoders().size(), 1U);
    ::kill(decoders().front(), SIGSTOP);
    (*player)->seek(0, 3.0);
    // Waits for what the decoder does not give.
    (*player)->wait_until_ready(4'096, [] { return true; });
    (*player)->stop();
    EXPECT_TRUE((*player)->take_messages().empty()) << "nobody waited until it counted as hung";
    player->reset();
    EXPECT_TRUE(decoders().empty());
}

TEST_F(Decoders, a_file_whose_decoder_never_answers_can_be_given_up) {
    const fs::path path = noise();
    const std::string program = std::getenv("RAKS_DECODER");
    const fs::path silent = path.parent_path() / "silent";
    ASSERT_TRUE(write_file(silent, "#!/bin/sh\nexec sleep 1000\n"));
    fs::permissions(silent, fs::perms::owner_all);
    setenv("RAKS_DECODER", silent.c_str(), 1);
    const auto reader = open_audio_file(path, [] { return true; });
    setenv("RAKS_DECODER", program.c_str(), 1);
    ASSERT_FALSE(reader);
    EXPECT_NE(reader.error().message.find("was stopped before its first sound"), std::string::npos)
        << reader.error().message;
}

TEST_F(Decoders, a_player_whose_decoder_is_killed_goes_on_with_the_next_file) {
    const fs::path path = noise();
    auto player = FilePlayer::start({path, path}, {});
    ASSERT_TRUE(player);
    (*player)->wait_until_ready(4'096);
    ASSERT_EQ(decoders().size(), 1U);
    ::kill(decoders().front(), SIGKILL);
    std::vector<float> block(2 * 1'024);
    PulledAudio pulled;
    while (!pulled.is_ended) {
        (*player)->wait_until_ready(1'024);
        pulled = (*player)->pull(block);
    }
    EXPECT_EQ(pulled.track, 1);
    const std::vector<std::string> messages = (*player)->take_messages();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_NE(messages.front().find("its decoder ended too soon"), std::string::npos);
}

TEST_F(Decoders, leave_no_descriptor_thread_or_process_behind) {
    const fs::path path = noise();
    ASSERT_TRUE(open_audio_file(path));  // what starts decoders stays
    const std::size_t descriptors = count_of("/proc/self/fd");
    const std::size_t threads = count_of("/proc/self/task");
    for (int i = 0; i < 50; ++i) {
        auto reader = open_audio_file(path);
        ASSERT_TRUE(reader) << reader.error().message;
        std::vector<float> block(2 * 1'000);
        EXPECT_EQ((*reader)->read(block), 1'000U);
    }
    EXPECT_EQ(count_of("/proc/self/fd"), descriptors);
    EXPECT_EQ(count_of("/proc/self/task"), threads);
    EXPECT_TRUE(decoders().empty());
}

TEST_F(Decoders, are_started_anew_when_what_starts_them_was_killed) {
    const fs::path path = noise();
    ASSERT_TRUE(open_audio_file(path));
    for (const int signal : {SIGKILL, SIGTERM}) {
        const std::vector<pid_t> server = raks::test::children_of(::getpid());
        ASSERT_EQ(server.size(), 1U);
        ::kill(server.front(), signal);
        const auto reader = open_audio_file(path);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_EQ(test::read_rest(**reader).size(), 2U * 6 * 48'000);
    }
}

TEST_F(Decoders, one_that_is_not_there_is_said) {
    const fs::path path = noise();
    const std::string program = std::getenv("RAKS_DECODER");
    setenv("RAKS_DECODER", "/nowhere/raks-decode", 1);
    const auto reader = open_audio_file(path);
    setenv("RAKS_DECODER", program.c_str(), 1);
    ASSERT_FALSE(reader);
    EXPECT_NE(reader.error().message.find("/nowhere/raks-decode: is not there"), std::string::npos);
}

TEST_F(Decoders, what_answers_nonsense_is_ended) {
    // Another program in its place: it ends without an answer.
    const fs::path path = noise();
    const std::string program = std::getenv("RAKS_DECODER");
    setenv("RAKS_DECODER", "/bin/true", 1);
    const auto reader = open_audio_file(path);
    setenv("RAKS_DECODER", program.c_str(), 1);
    ASSERT_FALSE(reader);
    EXPECT_NE(reader.error().message.find("ended too soon (exit code 0) before its first sound"),
              std::string::npos)
        << reader.error().message;
}

/// What a decoder has said before it was asked: a head, and then the same samples again and again.
Expected<std::unique_ptr<DecoderClient>> client_of_flooding_decoder(Descriptor& decoder) {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    Descriptor ours(ends[0]);
    decoder.number = ends[1];
    DecodeMessage message;
    message.kind = DecodeKind::opened;
    message.head = {.rate = 48'000, .channels = 2};
    message.set_text({});
    EXPECT_EQ(send_message(decoder.number, message), Talk::good);
    message.kind = DecodeKind::samples;
    message.value = 1;
    for (std::size_t i = 0; i < 3 * kDecodeSlots; ++i) {
        message.slot = i % kDecodeSlots;
        EXPECT_EQ(send_message(decoder.number, message), Talk::good);
    }
    const Descriptor file(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    DecodedSource source;
    source.name = "flood";
    source.descriptor = file.number;
    return DecoderClient::open(std::move(source), DecoderProcess::over(ours).value());
}

TEST(DecoderClient, lets_no_decoder_speak_to_a_terminal) {
    std::array<int, 2> ends{-1, -1};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    Descriptor ours(ends[0]);
    const Descriptor decoder(ends[1]);
    DecodeMessage message;
    message.kind = DecodeKind::failed;
    message.set_text("x.wav: is\n\x1b[2J no sound");
    ASSERT_EQ(send_message(decoder.number, message), Talk::good);
    const Descriptor file(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    DecodedSource source;
    source.descriptor = file.number;
    const auto client = DecoderClient::open(std::move(source), DecoderProcess::over(ours).value());
    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().message, "x.wav: is??[2J no sound");
}

TEST(DecoderClient, ends_a_decoder_that_answers_a_seek_with_samples_without_end) {
    Descriptor decoder;
    const auto client = client_of_flooding_decoder(decoder);
    ASSERT_TRUE(client) << client.error().message;
    const auto sought = (*client)->seek(100);
    ASSERT_FALSE(sought);
    EXPECT_EQ(
        sought.error().message,
        "flood: its decoder sent a broken answer and was ended at 0.00 s; the rest is left out");
}

}  // namespace
}  // namespace raks::audio
