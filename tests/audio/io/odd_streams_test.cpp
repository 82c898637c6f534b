// Files as recorders, web radios and damaged disks leave them: read to their true end, with one
// line that says what is out of the usual.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/head_bytes.hpp"
#include "audio/io/wav_writer.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/audio/io/sound_files.hpp"

namespace raks::audio {
namespace {

using test::drums;
using test::read_rest;
using ::testing::HasSubstr;

/// 16-bit samples of a tone of 440 Hz at half of full scale, and what a reader should make of it.
std::vector<float> tone(double seconds, int rate) {
    std::vector<float> samples(static_cast<std::size_t>(std::lround(seconds * rate)));
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double phase = 2.0 * std::numbers::pi * 440.0 * static_cast<double>(i) / rate;
        samples[i] = static_cast<float>(0.5 * std::sin(phase));
    }
    return samples;
}

/// How alike two sounds are, 1 for the same: over what both have.
double correlation(const std::vector<float>& a, const std::vector<float>& b) {
    double both = 0.0;
    double power_a = 0.0;
    double power_b = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        both += static_cast<double>(a[i]) * static_cast<double>(b[i]);
        power_a += static_cast<double>(a[i]) * static_cast<double>(a[i]);
        power_b += static_cast<double>(b[i]) * static_cast<double>(b[i]);
    }
    return both / std::sqrt(power_a * power_b + 1e-30);
}

class OddStreamsTest : public test::SoundFilesTest {
 protected:
    /// A WAV of drums, mono.
    std::filesystem::path make_wav(const std::string& name, double seconds, int rate) {
        const auto music = drums(seconds, rate, 1);
        EXPECT_TRUE(write_wav(folder_ / name, music.samples, 1, music.rate));
        return folder_ / name;
    }

    /// A file of these bytes.
    std::filesystem::path make_file(const std::string& name, std::string_view bytes) {
        EXPECT_TRUE(write_file(folder_ / name, bytes));
        return folder_ / name;
    }

    /// A WAV with any rate, also one that Raks does not work at.
    std::filesystem::path make_tone(const std::string& name, double seconds, int rate) {
        EXPECT_TRUE(write_wav(folder_ / name, tone(seconds, rate), 1, SampleRate(48'000)));
        std::string bytes = read_file(folder_ / name).value();
        const auto hertz = static_cast<std::uint64_t>(rate);
        bytes.replace(24, 4, bytes_of(hertz, 4, ByteOrder::little));
        bytes.replace(28, 4, bytes_of(2 * hertz, 4, ByteOrder::little));
        return make_file(name, bytes);
    }
};

TEST_F(OddStreamsTest, a_wav_without_a_length_is_read_to_its_end) {
    const auto whole = read_all_mono(make_wav("a.wav", 2.0, 16'000)).value();
    EXPECT_EQ(whole.warning, "");
    const std::string bytes = read_file(folder_ / "a.wav").value();
    const std::string list = "LIST" + bytes_of(26, 4, ByteOrder::little) + std::string(26, 'x');
    for (const std::uint64_t size : {std::uint64_t{0}, std::uint64_t{0xFFFF'FFFF}}) {
        for (const std::string& chunk : {std::string(), list}) {
            SCOPED_TRACE(std::to_string(size) + " behind " + std::to_string(chunk.size()));
            std::string bent = bytes;
            bent.replace(4, 4, bytes_of(size, 4, ByteOrder::little));
            bent.replace(40, 4, bytes_of(size, 4, ByteOrder::little));
            bent.insert(36, chunk);
            const auto mono = read_all_mono(make_file("open.wav", bent));
            ASSERT_TRUE(mono) << mono.error().message;
            EXPECT_EQ(mono->samples, whole.samples);
            EXPECT_EQ(mono->warning,
                      (folder_ / "open.wav").string() +
                          ": its header gives no length; it is read to the end of the file");
        }
    }
}

TEST_F(OddStreamsTest, what_is_written_to_a_file_while_it_is_read_is_left_out_and_said) {
    // Longer than what raks-decode decodes ahead, so that it cannot be at the end too soon.
    constexpr double kLength = 20.0;
    static_assert(kLength * 16'000 > kDecodeSlots * kDecodeSlotSamples);
    const auto path = make_wav("growing.wav", kLength, 16'000);
    const auto whole = read_all_mono(path).value();
    const auto reader = open_audio_file(path);
    ASSERT_TRUE(reader) << reader.error().message;
    std::ofstream(path, std::ios::binary | std::ios::app) << std::string(100'000, 'x');
    const std::vector<float> read = read_rest(**reader);
    EXPECT_EQ(read, whole.samples);
    EXPECT_THAT((*reader)->warning(), HasSubstr("while it was read"));
}

TEST_F(OddStreamsTest, a_wav_that_is_cut_off_says_how_much_is_missing) {
    const std::string bytes = read_file(make_wav("a.wav", 2.0, 16'000)).value();
    const auto mono =
        read_all_mono(make_file("cut.wav", std::string_view(bytes).substr(0, 44 + 32'000)));
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_EQ(mono->samples.size(), 16'000U);
    EXPECT_THAT(mono->warning, HasSubstr("cut off at 1.00 s; 1.00 s are missing"));
}

TEST_F(OddStreamsTest, a_wav_that_holds_nothing_on_purpose_is_not_called_open) {
    ASSERT_TRUE(write_wav(folder_ / "a.wav", {}, 1, SampleRate(16'000)));
    const auto mono = read_all_mono(folder_ / "a.wav");
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_TRUE(mono->samples.empty());
    EXPECT_EQ(mono->warning, "");
}

TEST_F(OddStreamsTest, ogg_streams_of_any_rate_follow_each_other) {
    const auto first = encode(make_wav("a.wav", 2.0, 16'000), "a.ogg", "-c:a libvorbis");
    const auto second = encode(make_wav("b.wav", 3.0, 24'000), "b.ogg", "-c:a libvorbis");
    const auto path = make_file("chain.ogg", read_file(first).value() + read_file(second).value());
    auto reader = open_audio_file(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ((*reader)->info().rate.hertz(), 16'000);
    EXPECT_NEAR((*reader)->info().claimed_seconds.value(), 5.0, 0.02);
    const auto samples = read_rest(**reader);
    EXPECT_NEAR(static_cast<double>(samples.size()), 5.0 * 16'000, 320);
    EXPECT_THAT((*reader)->warning(),
                HasSubstr("all are brought to the first's 16000 Hz and 1 channel"));

    // The second stream is the sound that ffmpeg makes of it at the first one's rate.
    const auto alone = encode(second, "alone.wav", "-ar 16000");
    auto expected = read_all_mono(alone).value().samples;
    const std::vector<float> heard(samples.end() - static_cast<std::ptrdiff_t>(expected.size()),
                                   samples.end());
    EXPECT_GT(correlation(heard, expected), 0.999);

    ASSERT_TRUE((*reader)->seek(40'000));
    const std::vector<float> rest(samples.begin() + 40'000, samples.end());
    EXPECT_EQ(read_rest(**reader), rest);
}

TEST_F(OddStreamsTest, ogg_streams_of_one_form_need_no_word) {
    const auto one = encode(make_wav("a.wav", 1.0, 16'000), "a.ogg", "-c:a libvorbis");
    const std::string bytes = read_file(one).value();
    const auto mono = read_all_mono(make_file("chain.ogg", bytes + bytes));
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_NEAR((static_cast<double>(mono->samples.size()) / mono->rate.hertz()), 2.0, 0.02);
    EXPECT_EQ(mono->warning, "");
}

TEST_F(OddStreamsTest, flacs_that_lie_one_behind_the_other_follow_each_other) {
    const auto wav = make_wav("a.wav", 1.0, 16'000);
    const auto other = make_wav("b.wav", 1.5, 16'000);
    const auto a = read_all_mono(wav).value().samples;
    const std::string first = read_file(encode(wav, "a.flac")).value();
    const std::string second = read_file(encode(other, "b.flac")).value();
    // A copy of the same ends with a frame that fits the first head, too.
    for (const std::string& next : {first, second}) {
        auto expected = a;
        const auto b = read_all_mono(make_file("next.flac", next)).value().samples;
        expected.insert(expected.end(), b.begin(), b.end());
        const auto mono = read_all_mono(make_file("joined.flac", first + next));
        ASSERT_TRUE(mono) << mono.error().message;
        EXPECT_EQ(mono->samples, expected);
        EXPECT_EQ(mono->warning, "");
    }
}

TEST_F(OddStreamsTest, mp3_in_a_wav_is_called_damaged_only_when_it_is) {
    const auto path =
        encode(make_wav("a.wav", 4.0, 44'100), "mp3.wav", "-c:a libmp3lame -b:a 128k");
    const auto whole = read_all_mono(path);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_NEAR(static_cast<double>(whole->samples.size()) / 44'100, 4.0, 0.1);
    EXPECT_EQ(whole->warning, "");
    const std::string bytes = read_file(path).value();
    const auto cut =
        read_all_mono(make_file("cut.wav", std::string_view(bytes).substr(0, bytes.size() / 2)));
    ASSERT_TRUE(cut) << cut.error().message;
    EXPECT_THAT(cut->warning, HasSubstr("s are missing"));
}

TEST_F(OddStreamsTest, a_flac_is_read_past_a_total_that_is_too_small) {
    const auto wav = make_wav("a.wav", 2.0, 16'000);
    const auto whole = read_all_mono(wav).value();
    const std::string bytes = read_file(encode(wav, "a.flac")).value();
    for (const std::uint64_t total : {0U, 9'000U}) {
        SCOPED_TRACE(total);
        std::string bent = bytes;
        const std::uint64_t packed = number_at(bent, 18, 8, ByteOrder::big);
        bent.replace(
            18, 8, bytes_of((packed & ~std::uint64_t{0xF'FFFF'FFFF}) | total, 8, ByteOrder::big));
        const auto mono = read_all_mono(make_file("bent.flac", bent));
        ASSERT_TRUE(mono) << mono.error().message;
        EXPECT_EQ(mono->samples, whole.samples);
        // A total of 0 is FLAC's own way to say that it is unknown.
        EXPECT_EQ(mono->warning.empty(), total == 0) << mono->warning;
    }
}

TEST_F(OddStreamsTest, a_flac_that_ends_before_its_total_says_what_is_missing) {
    const auto wav = make_wav("a.wav", 2.0, 16'000);
    std::string bytes = read_file(encode(wav, "a.flac")).value();
    const std::uint64_t packed = number_at(bytes, 18, 8, ByteOrder::big);
    bytes.replace(18, 8, bytes_of(packed + 16'000, 8, ByteOrder::big));
    const auto mono = read_all_mono(make_file("long.flac", bytes));
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_EQ(mono->samples.size(), 32'000U);
    EXPECT_THAT(mono->warning, HasSubstr("cut off at 2.00 s; 1.00 s are missing"));
}

TEST_F(OddStreamsTest, stereo_with_one_side_upside_down_is_heard_from_the_side) {
    const auto music = drums(2.0, 16'000, 1);
    std::vector<float> stereo;
    for (const float sample : music.samples) {
        stereo.insert(stereo.end(), {sample, -sample});
    }
    ASSERT_TRUE(write_wav(folder_ / "a.wav", stereo, 2, music.rate));
    ASSERT_TRUE(write_wav(folder_ / "mono.wav", music.samples, 1, music.rate));
    const auto mono = read_all_mono(folder_ / "a.wav");
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_GT(correlation(mono->samples, read_all_mono(folder_ / "mono.wav").value().samples),
              0.9999);
    EXPECT_THAT(mono->warning, HasSubstr("left and right cancel each other"));
}

TEST_F(OddStreamsTest, rates_outside_the_range_are_resampled) {
    struct Case {
        int rate;
        int heard_at;
    };
    for (const Case& rate : {Case{4'000, 8'000}, Case{384'000, 192'000}}) {
        SCOPED_TRACE(rate.rate);
        const auto path = make_tone("tone.wav", 1.0, rate.rate);
        auto reader = open_audio_file(path);
        ASSERT_TRUE(reader) << reader.error().message;
        EXPECT_EQ((*reader)->info().rate.hertz(), rate.heard_at);
        EXPECT_NEAR((*reader)->info().claimed_seconds.value(), 1.0, 0.001);
        const auto samples = read_rest(**reader);
        const auto expected = tone(1.0, rate.heard_at);
        EXPECT_EQ(samples.size(), expected.size());
        EXPECT_GT(correlation(samples, expected), 0.999);
        EXPECT_EQ((*reader)->warning(),
                  path.string() + ": has " + std::to_string(rate.rate) + " Hz; resampled to " +
                      std::to_string(rate.heard_at) + " Hz, as Raks works at 8000 to 192000");
        ASSERT_TRUE((*reader)->seek(5'000));
        EXPECT_EQ(read_rest(**reader), std::vector<float>(samples.begin() + 5'000, samples.end()));
    }
}

TEST_F(OddStreamsTest, sound_that_starts_late_in_a_film_starts_late) {
    const auto wav = make_wav("a.wav", 2.0, 16'000);
    const auto film = encode(wav,
                             "late.mkv",
                             "-f lavfi -i color=black:size=32x32:rate=5:duration=4 "
                             "-map 1:v -map 0:a -c:a flac -filter:a asetpts=PTS+1.5/TB");
    const auto mono = read_all_mono(film);
    ASSERT_TRUE(mono) << mono.error().message;
    EXPECT_NEAR((static_cast<double>(mono->samples.size()) / mono->rate.hertz()), 3.5, 0.02);
    EXPECT_EQ(mono->warning, "");
    const auto lead = mono->samples.begin() + 23'900;
    EXPECT_TRUE(std::all_of(mono->samples.begin(), lead, [](float x) { return x == 0.0F; }));
}

TEST_F(OddStreamsTest, an_mp4_that_is_cut_before_its_index_says_so) {
    const auto wav = make_wav("a.wav", 2.0, 16'000);
    const std::string bytes = read_file(encode(wav, "a.m4a")).value();
    const auto reader =
        open_audio_file(make_file("cut.m4a", std::string_view(bytes).substr(0, bytes.size() / 2)));
    ASSERT_FALSE(reader);
    EXPECT_THAT(reader.error().message, HasSubstr("cut off at "));
    EXPECT_THAT(reader.error().message, HasSubstr("before its index"));
}

}  // namespace
}  // namespace raks::audio
