#include "engine/outputs/video_pipe.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>

#include "base/descriptor.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

constexpr VideoFormat kTiny{.width = 3, .height = 2};

/// Larger than any pipe.
constexpr VideoFormat kLarge{.width = 1000, .height = 600};

class NamedPipe : public ::testing::Test {
 protected:
    NamedPipe() {
        // As the programs do: a reader that has left is an error of the write.
        static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
        EXPECT_EQ(mkfifo(name().c_str(), 0600), 0);
    }
    [[nodiscard]] std::string name() const { return (folder_ / "pipe").string(); }
    [[nodiscard]] std::unique_ptr<VideoSink> sink(const VideoFormat& format,
                                                  PixelForm form = PixelForm::rgba) const {
        auto opened = open_video_pipe(name(), form, format);
        EXPECT_TRUE(opened) << opened.error().message;
        return std::move(*opened);
    }
    [[nodiscard]] Descriptor reader() const {
        return Descriptor(open(name().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    }
    /// All that is there now, at most `most` bytes.
    static std::string taken(const Descriptor& from, std::size_t most = 1 << 24) {
        std::string bytes;
        std::array<char, 65536> part{};
        while (bytes.size() < most) {
            const ssize_t got =
                read(from.number, part.data(), std::min(part.size(), most - bytes.size()));
            if (got <= 0) {
                break;
            }
            bytes.append(part.data(), static_cast<std::size_t>(got));
        }
        return bytes;
    }

    test::TemporaryFolder folder_;
};

std::vector<std::uint8_t> plain(const VideoFormat& format, std::uint8_t value) {
    return std::vector<std::uint8_t>(format.bytes(), value);
}

TEST_F(NamedPipe, waits_for_its_reader_and_gives_it_whole_pictures) {
    const auto sink = this->sink(kTiny);
    sink->send(plain(kTiny, 1));
    EXPECT_EQ(sink->sent(), 0U) << "nobody reads";
    const Descriptor reading = reader();
    sink->send(plain(kTiny, 2));
    sink->send(plain(kTiny, 3));
    EXPECT_EQ(taken(reading), std::string(24, '\2') + std::string(24, '\3'));
    EXPECT_EQ(sink->sent(), 2U);
    EXPECT_FALSE(sink->take_trouble());
}

TEST_F(NamedPipe, a_reader_that_leaves_is_said_once_and_the_next_begins_with_a_whole_picture) {
    const auto sink = this->sink(kLarge);
    {
        const Descriptor reading = reader();
        sink->send(plain(kLarge, 1));
        EXPECT_FALSE(taken(reading, 1000).empty());
    }
    sink->send(plain(kLarge, 2));
    const auto trouble = sink->take_trouble();
    ASSERT_TRUE(trouble);
    EXPECT_NE(trouble->find("its reader has left; waiting for another"), std::string::npos);
    const Descriptor reading = reader();
    sink->send(plain(kLarge, 3));
    const std::string begun = taken(reading);
    EXPECT_FALSE(begun.empty());
    EXPECT_EQ(begun, std::string(begun.size(), '\3')) << "nothing is left of the picture before";
    EXPECT_FALSE(sink->take_trouble());
}

TEST_F(NamedPipe, a_slow_reader_loses_whole_pictures_and_nothing_else) {
    const auto sink = this->sink(kLarge);
    const Descriptor reading = reader();
    std::string bytes;
    for (std::uint8_t number = 1; number <= 40; ++number) {
        sink->send(plain(kLarge, number));
        bytes += taken(reading, kLarge.bytes() / 3);
    }
    EXPECT_GT(sink->dropped(), 10U);
    EXPECT_EQ(sink->sent() + sink->dropped(), 40U);
    for (std::size_t at = 0; at + kLarge.bytes() <= bytes.size(); at += kLarge.bytes()) {
        const std::string picture = bytes.substr(at, kLarge.bytes());
        EXPECT_EQ(picture, std::string(picture.size(), picture.front()));
    }
}

TEST_F(NamedPipe, y4m_begins_with_its_head_for_each_reader) {
    const auto sink = this->sink(kTiny, PixelForm::y4m);
    const std::string picture =
        "FRAME\n" + std::string(6, '\xEB') + std::string(12, '\x80');  // white
    std::string expected = "YUV4MPEG2 W3 H2 F30:1 Ip A1:1 C444\n";
    expected.append(picture).append(picture);
    for (int i = 0; i < 2; ++i) {
        Descriptor reading = reader();
        sink->send(plain(kTiny, 255));
        sink->send(plain(kTiny, 255));
        EXPECT_EQ(taken(reading), expected);
        reading.close();
        sink->send(plain(kTiny, 255));  // that nobody reads shows now
    }
}

TEST(VideoPipe, refuses_what_is_no_pipe_in_one_line) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "song.wav", "precious"));
    for (const auto& [name, part] :
         {std::pair{"song.wav", "is no pipe"}, {"nowhere", "mkfifo"}, {"", "is no pipe"}}) {
        const auto opened = open_video_pipe((folder / name).string(), PixelForm::rgba, {});
        ASSERT_FALSE(opened) << name;
        EXPECT_NE(opened.error().message.find(part), std::string::npos) << opened.error().message;
        EXPECT_EQ(opened.error().message.find('\n'), std::string::npos);
    }
    EXPECT_EQ(read_file(folder / "song.wav", 100).value(), "precious");
}

TEST(VideoPipe, the_matrix_is_that_of_bt601_within_one_step) {
    for (int r = 0; r <= 255; r += 51) {
        for (int g = 0; g <= 255; g += 51) {
            for (int b = 0; b <= 255; b += 51) {
                const std::array<std::uint8_t, 4> rgba = {static_cast<std::uint8_t>(r),
                                                          static_cast<std::uint8_t>(g),
                                                          static_cast<std::uint8_t>(b),
                                                          255};
                std::array<std::uint8_t, 3> yuv{};
                to_yuv444(rgba, yuv);
                const double luma = (0.299 * r + 0.587 * g + 0.114 * b) / 255.0;
                EXPECT_NEAR(yuv[0], 16.0 + 219.0 * luma, 1.0);
                EXPECT_NEAR(yuv[1], 128.0 + 224.0 * (b / 255.0 - luma) / 1.772, 1.0);
                EXPECT_NEAR(yuv[2], 128.0 + 224.0 * (r / 255.0 - luma) / 1.402, 1.0);
            }
        }
    }
}

}  // namespace
}  // namespace raks::engine
