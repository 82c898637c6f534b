#include "audio/io/opus_stamps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "audio/io/wav_writer.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/audio/io/sound_files.hpp"

namespace raks::audio {
namespace {

using test::drums;
using test::read_rest;
using ::testing::HasSubstr;

// Packets of 20 ms by their first byte; with more bytes than a segment holds they go on.
constexpr char kTwentyMilliseconds = '\xf8';
constexpr std::int64_t kPacket = 960;

TEST(OpusStampsTest, a_packet_is_as_long_as_its_first_bytes_say) {
    EXPECT_EQ(opus_packet_samples(""), 0);
    EXPECT_EQ(opus_packet_samples({"\x00", 1}), 480);     // SILK, 10 ms
    EXPECT_EQ(opus_packet_samples("\x58"), 2880);         // SILK, 60 ms
    EXPECT_EQ(opus_packet_samples("\x78"), 960);          // hybrid, 20 ms
    EXPECT_EQ(opus_packet_samples("\xe0"), 120);          // CELT, 2.5 ms
    EXPECT_EQ(opus_packet_samples("\xf9"), 2 * 960);      // two of the same size
    EXPECT_EQ(opus_packet_samples("\xfa"), 2 * 960);      // two of different sizes
    EXPECT_EQ(opus_packet_samples("\xfb\x05"), 5 * 960);  // any number: the second byte's
    EXPECT_EQ(opus_packet_samples("\xfb"), 0);            // which is not there
}

/// A stream whose pages have `packets` packets of 20 ms each and these positions; the last page is
/// marked so.
bool agrees(const std::vector<std::pair<std::size_t, std::int64_t>>& pages) {
    OpusStamps stamps;
    stamps.add({0, false, "\x13", "OpusHead..........."});
    stamps.add({0, false, "\x08", "OpusTags"});
    for (std::size_t i = 0; i < pages.size(); ++i) {
        const std::string segments(pages[i].first, '\x01');
        const std::string body(pages[i].first, kTwentyMilliseconds);
        stamps.add({pages[i].second, i + 1 == pages.size(), segments, body});
    }
    return stamps.agree();
}

TEST(OpusStampsTest, positions_must_be_what_the_packets_add_and_less_at_the_end_alone) {
    EXPECT_TRUE(agrees({{50, 50 * kPacket}, {50, 100 * kPacket}, {2, 101 * kPacket}}));
    EXPECT_TRUE(agrees({{50, 77'000}, {50, 77'000 + 50 * kPacket}})) << "any start will do";
    EXPECT_FALSE(agrees({{50, 50 * kPacket}, {50, 100 * kPacket + 488}, {50, 150 * kPacket}}));
    EXPECT_FALSE(agrees({{50, 50 * kPacket}, {50, 100 * kPacket - 1}, {50, 150 * kPacket - 1}}));
    EXPECT_FALSE(agrees({{50, 50 * kPacket}, {1, 51 * kPacket + 1}})) << "more than there is";
}

TEST(OpusStampsTest, a_packet_belongs_to_the_page_that_it_ends_in) {
    OpusStamps stamps;
    stamps.add({0, false, "\x08", "OpusHead"});
    stamps.add({0, false, "\x08", "OpusTags"});
    stamps.add({kPacket, false, "\x01", "\xf8"});
    stamps.add({-1, false, "\xff", "\xf8" + std::string(254, 'x')});
    stamps.add({2 * kPacket, false, "\x01", "x"});
    EXPECT_TRUE(stamps.agree());
    stamps.add({4 * kPacket, true, "\x01", "\xf8"});
    EXPECT_FALSE(stamps.agree());
}

class OpusFilesTest : public test::SoundFilesTest {
 protected:
    std::filesystem::path make_wav(double seconds) {
        const auto music = drums(seconds, 48'000, 1);
        EXPECT_TRUE(write_wav(folder_ / "in.wav", music.samples, 1, music.rate));
        return folder_ / "in.wav";
    }

    /// Opus whose time stamps are 488 samples late from 2.5 s to `until`, as ffmpeg makes it where
    /// it follows the stamps of another file.
    std::filesystem::path make_loose(double until) {
        return encode(make_wav(6.0),
                      "loose.opus",
                      "-b:a 96k -af \"asetnsamples=960,asetpts='PTS+if(between(T,2.5," +
                          std::to_string(until) + "),488,0)'\"");
    }
};

TEST_F(OpusFilesTest, opus_of_any_length_and_size_of_packets_is_whole) {
    for (const double seconds : {0.013, 0.5, 1.007, 3.333}) {
        for (const char* packet : {"2.5", "20", "60"}) {
            SCOPED_TRACE(std::to_string(seconds) + " s of " + packet + " ms");
            const auto file = encode(
                make_wav(seconds), "x.opus", std::string("-c:a libopus -frame_duration ") + packet);
            const auto mono = read_all_mono(file);
            ASSERT_TRUE(mono) << mono.error().message;
            EXPECT_EQ(mono->samples.size(),
                      static_cast<std::size_t>(std::lround(seconds * 48'000)));
            EXPECT_EQ(mono->warning, "");
        }
    }
}

TEST_F(OpusFilesTest, positions_beside_the_packets_lose_no_sound_and_need_no_word) {
    const auto plain = read_all_mono(encode(make_wav(6.0), "plain.opus", "-b:a 96k")).value();
    // Late for a while, and late until after the last page but one.
    for (const double until : {3.4, 5.4}) {
        SCOPED_TRACE(until);
        auto reader = open_audio_file(make_loose(until));
        ASSERT_TRUE(reader) << reader.error().message;
        const std::vector<float> all = read_rest(**reader);
        EXPECT_EQ((*reader)->warning(), "");
        ASSERT_NEAR(static_cast<double>(all.size()), 6.0 * 48'000, 488);
        double worst = 0.0;
        for (std::size_t i = 0; i < all.size() && i < plain.samples.size(); ++i) {
            worst = std::max(worst, std::abs(static_cast<double>(all[i] - plain.samples[i])));
        }
        EXPECT_LT(worst, 1e-3) << "of full scale, between two decoders";
        for (const std::size_t place : {20'000U, 140'000U, 170'000U, 250'000U}) {
            ASSERT_TRUE((*reader)->seek(static_cast<std::int64_t>(place)));
            const std::vector<float> rest = read_rest(**reader);
            ASSERT_EQ(rest.size(), all.size() - place) << place;
            EXPECT_NEAR(rest[5'000], all[place + 5'000], 1e-3) << place;
            EXPECT_NEAR(rest[5'001], all[place + 5'001], 1e-3) << place;
        }
    }
}

TEST_F(OpusFilesTest, opus_that_is_cut_off_says_so_wherever_its_positions_lie) {
    for (const auto& file : {make_loose(3.4), encode(make_wav(6.0), "plain.opus", "-b:a 96k")}) {
        const std::string bytes = read_file(file).value();
        ASSERT_TRUE(write_file(folder_ / "cut.opus",
                               std::string_view(bytes).substr(0, bytes.size() * 8 / 10)));
        const auto mono = read_all_mono(folder_ / "cut.opus");
        ASSERT_TRUE(mono) << mono.error().message;
        EXPECT_LT(mono->samples.size(), 5U * 48'000U);
        EXPECT_THAT(mono->warning, HasSubstr("is damaged or cut off at ")) << file;
    }
}

}  // namespace
}  // namespace raks::audio
