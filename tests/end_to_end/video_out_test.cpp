// Pictures that `raks play` gives to other programs through pipes.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

constexpr std::size_t kWidth = 160;
constexpr std::size_t kHeight = 96;
constexpr std::size_t kPicture = kWidth * kHeight * 4;

class VideoOut : public ProgramTest {
 protected:
    [[nodiscard]] std::vector<std::string> play(std::vector<std::string> more) const {
        std::vector<std::string> arguments = {
            "play", path("clicks.wav"), "--no-sound", "--headless", "--quit", "--size", "160x96"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
};

TEST_F(VideoOut, standard_output_has_whole_pictures_with_alpha_and_nothing_else) {
    write_clicks("clicks.wav", 4.0);
    const ProcessResult result = run(play({"--video-out", "-", "--backdrop", "transparent"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    ASSERT_GT(result.out.size(), 30 * kPicture);
    EXPECT_EQ(result.out.size() % kPicture, 0U);
    std::set<std::string> different;
    for (std::size_t at = 0; at < result.out.size(); at += kPicture) {
        const std::string picture = result.out.substr(at, kPicture);
        EXPECT_EQ(picture.substr(0, 4), std::string(4, '\0')) << "a corner is not transparent";
        int opaque = 0;
        for (std::size_t i = 0; i < kPicture; i += 4) {
            const auto alpha = static_cast<unsigned char>(picture[i + 3]);
            opaque += alpha == 255 ? 1 : 0;
            for (std::size_t c = i; c < i + 3; ++c) {
                ASSERT_LE(static_cast<unsigned char>(picture[c]), alpha + 1) << "not premultiplied";
            }
        }
        EXPECT_GT(opaque, 200) << "nobody is seen";
        different.insert(picture);
    }
    EXPECT_GT(different.size(), 20U);
}

TEST_F(VideoOut, y4m_on_a_key_colour_is_what_ffmpeg_reads) {
    write_clicks("clicks.wav", 2.0);
    const ProcessResult result = run(
        play({"--video-out", "-", "--video-form", "y4m", "--backdrop", "#0000ff", "--fps", "25"}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    ASSERT_TRUE(write_file(path("x.y4m"), result.out));
    ProcessPlan ffmpeg;
    ffmpeg.command = {
        "ffmpeg", "-v", "warning", "-i", path("x.y4m"), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"};
    const ProcessResult read = run_process(ffmpeg);
    EXPECT_EQ(read.exit_code, 0);
    EXPECT_EQ(read.err, "");
    constexpr std::size_t kRead = kWidth * kHeight * 3;
    ASSERT_GT(read.out.size(), 10 * kRead);
    EXPECT_EQ(read.out.size() % kRead, 0U);
    EXPECT_LE(static_cast<unsigned char>(read.out[0]), 3);
    EXPECT_LE(static_cast<unsigned char>(read.out[1]), 3);
    EXPECT_GE(static_cast<unsigned char>(read.out[2]), 252);
}

TEST_F(VideoOut, a_reader_that_leaves_ends_the_pictures_and_not_the_show) {
    write_clicks("clicks.wav", 4.0);
    ProcessPlan shell;
    shell = plan({});
    std::string command = RAKS_PROGRAM;
    for (const std::string& argument : play({"--video-out", "-"})) {
        command += " '" + argument + "'";
    }
    shell.command = {"sh", "-c", "{ " + command + "; echo \"code $?\" >&2; } | head -c 100000 >&-"};
    const ProcessResult result = run_process(shell);
    EXPECT_NE(result.err.find("--video-out -: its reader has left; no more pictures go there"),
              std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("code 0"), std::string::npos) << result.err;
}

TEST_F(VideoOut, wrong_usage_is_one_line) {
    write_clicks("clicks.wav", 1.0);
    expect_one_line(play({"--video-out", "-", "--lines", "-"}), 2, "only one output");
    expect_one_line(play({"--video-out", "-", "--video-out", "-"}), 2, "only one output");
    expect_one_line(play({"--video-out", "-", "--video-form", "y4m", "--backdrop", "transparent"}),
                    2,
                    "--backdrop a colour");
    expect_one_line(play({"--video-out", "-", "--video-form", "mp4"}), 2, "rgba, y4m");
    expect_one_line(play({"--video-out", path("no_pipe")}), 1, "mkfifo");
    expect_one_line(play({"--video-out", path("clicks.wav")}), 1, "is no pipe");
    expect_one_line(play({"--video-out", "pipewire:"}), 1, "no name behind the colon");
}

}  // namespace
}  // namespace raks::test
