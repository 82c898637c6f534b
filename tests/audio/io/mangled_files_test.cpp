// Files cut and bent in every way: whatever is in them, the reader ends with a result or one line,
// soon, with bounded memory and without a word on stderr.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "audio/io/decoders.hpp"
#include "audio/io/file_window.hpp"
#include "audio/io/wav_writer.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "tests/audio/io/sound_files.hpp"
#include "tests/support/damaged_file.hpp"

namespace raks::audio {
namespace {

using test::drums;

class MangledFilesTest : public test::SoundFilesTest,
                         public ::testing::WithParamInterface<const char*> {
 protected:
    /// A short piece in the format of this test.
    std::string tiny() {
        const auto music = drums(0.12, 16'000, 1);
        EXPECT_TRUE(write_wav(folder_ / "in.wav", music.samples, 1, music.rate));
        const bool is_opus = std::string_view(GetParam()).ends_with("opus");
        return read_file(encode(folder_ / "in.wav", GetParam(), is_opus ? "" : "-ar 16000"))
            .value();
    }

    /// Opens, reads, seeks and reads again.
    void try_to_play(std::string_view bytes) {
        const auto path = folder_ / "bad";
        raks::test::write_damaged(path, bytes);
        // Decoded in this process: a child for each of thousands of files takes minutes, and here
        // the sanitizers see what happens. decoder_client_test.cpp tries the child.
        const auto window = FileWindow::open(path);
        auto reader = window ? open_by_decoders(path, *window) : fail(window.error());
        if (!reader) {
            const std::string& line = reader.error().message;
            EXPECT_EQ(line.rfind(path.string() + ": ", 0), 0U) << line;
            EXPECT_EQ(line.find('\n'), std::string::npos) << line;
            return;
        }
        const auto channels = static_cast<std::size_t>((*reader)->info().channels);
        ASSERT_GE(channels, 1U);
        ASSERT_TRUE((*reader)->info().rate.is_supported());
        std::vector<float> chunk(1024 * channels);
        std::size_t frames = 0;
        while (const std::size_t got = (*reader)->read(chunk)) {
            frames += got;
            ASSERT_LT(frames, std::size_t{1} << 24U) << "does a tiny file never end?";
        }
        if ((*reader)->seek(500)) {
            (*reader)->read(chunk);
        }
    }
};

TEST_P(MangledFilesTest, cut_at_every_offset) {
    const std::string bytes = tiny();
    ASSERT_LT(bytes.size(), 16'000U);
    const std::size_t step = bytes.size() > 5'000 ? 5 : 1;
    ::testing::internal::CaptureStderr();
    for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : step) {
        SCOPED_TRACE("cut to " + std::to_string(size));
        try_to_play(std::string_view(bytes).substr(0, size));
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(MangledFilesTest, flipped_bits) {
    const std::string bytes = tiny();
    ::testing::internal::CaptureStderr();
    for (std::uint64_t round = 0; round < 300; ++round) {
        SCOPED_TRACE("round " + std::to_string(round));
        const CounterRandom random(42, round);
        std::string bent = bytes;
        const std::uint64_t flips = 1 + random.below(0, 8);
        for (std::uint64_t i = 1; i <= flips; ++i) {
            // Half of them in the head, where they hurt.
            const std::size_t reach =
                i % 2 == 0 ? bent.size() : std::min<std::size_t>(bent.size(), 100);
            const std::uint64_t at = random.below(2 * i, reach);
            bent[at] = static_cast<char>(bent[at] ^ (1 << random.below(2 * i + 1, 8)));
        }
        try_to_play(bent);
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         MangledFilesTest,
                         ::testing::Values("x.wav", "x.flac", "x.ogg", "x.opus", "x.mp3", "x.m4a"),
                         [](const auto& format) { return std::string(format.param).substr(2); });

}  // namespace
}  // namespace raks::audio
