// The readers of heads, alone: whatever is in a file, they end with numbers that make sense.
#include <gtest/gtest.h>

#include "audio/io/container_extent.hpp"
#include "audio/io/flac_length.hpp"
#include "audio/io/mended_head.hpp"
#include "audio/io/ogg_links.hpp"
#include "audio/io/wav_writer.hpp"
#include "base/file.hpp"
#include "tests/audio/io/sound_files.hpp"
#include "tests/support/damaged_file.hpp"
#include "tests/support/mangled.hpp"

namespace raks::audio {
namespace {

using test::drums;

struct HeadFormat {
    const char* name;     ///< of the file; its part before the dot names the test
    const char* options;  ///< of the ffmpeg program
};

class OddHeadsTest : public test::SoundFilesTest, public ::testing::WithParamInterface<HeadFormat> {
 protected:
    /// A short piece in the format of this test.
    std::string tiny() {
        const auto music = drums(0.1, 8'000, 1);
        EXPECT_TRUE(write_wav(folder_ / "in.wav", music.samples, 1, music.rate));
        return read_file(encode(folder_ / "in.wav", GetParam().name, GetParam().options)).value();
    }

    /// Gives the bytes to every reader of heads.
    void try_heads(std::string_view bytes) {
        const auto path = folder_ / "bad";
        raks::test::write_damaged(path, bytes);
        const FileWindow file = FileWindow::open(path).value();
        const MendedHead mended = mend_head(file);
        EXPECT_GE(mended.missing_seconds, 0.0);
        expect_readable(mended.window, file);
        const FlacLength flac = read_flac_length(file);
        expect_readable(flac.window, file);
        EXPECT_GE(flac.found, 0);
        ASSERT_FALSE(flac.starts.empty());
        EXPECT_LT(flac.starts.back(), std::max<std::int64_t>(file.size(), 1));
        std::int64_t end = 0;
        for (const OggLink& link : read_ogg_pages(file).links) {
            EXPECT_LE(end, link.begin);
            EXPECT_LT(link.begin, link.end);
            end = link.end;
        }
        EXPECT_LE(end, file.size());
        EXPECT_GE(read_container_extent(file).missing_bytes, 0);
    }

    /// A mended head may be longer than the one in the file, but not by much.
    static void expect_readable(const FileWindow& window, const FileWindow& file) {
        constexpr std::int64_t kMostAdded = 2'048;
        EXPECT_LE(window.size(), file.size() + kMostAdded);
        const auto size = static_cast<std::size_t>(window.size());
        EXPECT_EQ(window.bytes(0, size + 1).size(), size);
    }
};

TEST_P(OddHeadsTest, cut_at_every_byte) {
    const std::string bytes = tiny();
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        SCOPED_TRACE("cut to " + std::to_string(size));
        try_heads(std::string_view(bytes).substr(0, size));
    }
}

TEST_P(OddHeadsTest, mangled_bytes) {
    const std::string bytes = tiny();
    for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        // Half of them in the head, where they hurt.
        try_heads(raks::test::mangled(
            bytes, {.seed = seed, .bytes = 1 + seed % 5, .reach = seed % 2 == 0 ? 100U : 5'000U}));
    }
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         OddHeadsTest,
                         ::testing::Values(HeadFormat{"wav.wav", ""},
                                           HeadFormat{"rf64.wav", "-rf64 always"},
                                           HeadFormat{"w64.w64", ""},
                                           HeadFormat{"aiff.aiff", ""},
                                           HeadFormat{"au.au", ""},
                                           HeadFormat{"caf.caf", ""},
                                           HeadFormat{"flac.flac", ""},
                                           HeadFormat{"ogg.ogg", "-c:a libvorbis -ar 16000"},
                                           HeadFormat{"mp4.m4a", ""},
                                           HeadFormat{"mka.mka", ""},
                                           HeadFormat{"avi.avi", "-c:a pcm_s16le"}),
                         [](const auto& format) {
                             const std::string name = format.param.name;
                             return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace raks::audio
