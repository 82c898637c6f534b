// Pictures that `raks play` gives to other programs through pipes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
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

/// Films of the show while it runs.
class Record : public VideoOut {
 protected:
    /// Pictures as FFmpeg's own program decodes them, grey, a byte a pixel.
    [[nodiscard]] std::string pictures(const std::string& film) const {
        return ffmpeg({"-i", path(film), "-f", "rawvideo", "-pix_fmt", "gray", "-"});
    }
    [[nodiscard]] std::vector<float> sound(const std::string& film) const {
        const std::string bytes =
            ffmpeg({"-i", path(film), "-af", "pan=mono|c0=c0", "-ar", "48000", "-f", "f32le", "-"});
        std::vector<float> samples(bytes.size() / sizeof(float));
        std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
        return samples;
    }
    static std::string ffmpeg(const std::vector<std::string>& arguments) {
        ProcessPlan plan;
        plan.command = {"ffmpeg", "-v", "error"};
        plan.command.insert(plan.command.end(), arguments.begin(), arguments.end());
        return run_process(plan).out;
    }
    /// Where the first click begins, in seconds.
    static double first_click(const std::vector<float>& samples) {
        const auto at = std::find_if(
            samples.begin(), samples.end(), [](float sample) { return std::abs(sample) > 0.1F; });
        return static_cast<double>(at - samples.begin()) / 48'000.0;
    }
    static constexpr std::size_t kGrey = kWidth * kHeight;
    /// Mean difference of picture `a` of one film and `b` of another.
    static double difference(const std::string& one,
                             std::size_t a,
                             const std::string& other,
                             std::size_t b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < kGrey; ++i) {
            sum += std::abs(static_cast<unsigned char>(one[a * kGrey + i]) -
                            static_cast<unsigned char>(other[b * kGrey + i]));
        }
        return sum / kGrey;
    }
};

// The same seed and the same music: what is filmed while it plays is what `render` makes of it. As
// it comes: a busy machine knows a song too late. It also shows pictures twice; half are enough.
TEST_F(Record, is_the_film_that_render_makes) {
    write_clicks("clicks.wav", 8.0);
    const ProcessResult played = run(
        play({"--record", path("live.mp4"), "--camera", "wide", "--quality", "fast", "--as-live"}));
    EXPECT_EQ(played.exit_code, 0) << played.err;
    EXPECT_NE(played.err.find("recorded: " + path("live.mp4")), std::string::npos) << played.err;
    ASSERT_EQ(run({"render",
                   path("clicks.wav"),
                   "-o",
                   path("made.mp4"),
                   "--size",
                   "160x96",
                   "--camera",
                   "wide",
                   "--quality",
                   "fast",
                   "--as-live"})
                  .exit_code,
              0);
    const std::string live = pictures("live.mp4");
    const std::string made = pictures("made.mp4");
    ASSERT_GT(live.size(), 225 * kGrey);
    EXPECT_NEAR(static_cast<double>(live.size()) / kGrey, 240.0, 12.0);
    EXPECT_NEAR(first_click(sound("live.mp4")), first_click(sound("made.mp4")), 0.003);
    int right = 0;
    int compared = 0;
    for (std::size_t i = 90; i < 210; i += 5, ++compared) {
        const double same = difference(live, i, made, i);
        right += same < difference(live, i, made, i - 4) && same < difference(live, i, made, i + 4)
                     ? 1
                     : 0;
    }
    EXPECT_GE(right, compared / 2) << "of " << compared;
}

TEST_F(Record, what_was_danced_plays_when_the_program_is_killed) {
    write_clicks("clicks.wav", 30.0);
    CapturedProcess raks(plan(play({"--record", path("x.mp4")})));
    ASSERT_TRUE(raks.wait_for_output("playing"));
    const auto part = [&]() -> std::string {
        for (const std::string& name : files()) {
            if (name.find("x.mp4") != std::string::npos) {
                return name;
            }
        }
        return {};
    };
    // Until about six seconds are there, by their size on the disk.
    std::string name;
    ASSERT_TRUE(raks.wait_until([&](const ProcessResult&) {
        name = part();
        return !name.empty() && pictures(name).size() > 150 * kGrey;
    }));
    raks.send(SIGKILL);
    raks.wait();
    EXPECT_GT(pictures(name).size(), 150 * kGrey);
    EXPECT_GT(sound(name).size(), 4U * 48'000U);
}

TEST_F(Record, is_finished_when_the_program_is_told_to_end) {
    write_clicks("clicks.wav", 60.0);
    CapturedProcess raks(plan(play({"--record", path("x.mp4")})));
    ASSERT_TRUE(raks.wait_until([&](const ProcessResult&) {
        const auto there = files();
        return std::any_of(there.begin(), there.end(), [&](const std::string& name) {
            return name.find("x.mp4") != std::string::npos && pictures(name).size() > 30 * kGrey;
        });
    }));
    raks.send(SIGINT);
    const ProcessResult ended = raks.wait();
    EXPECT_EQ(ended.exit_code, 130);
    EXPECT_NE(ended.err.find("recorded: " + path("x.mp4")), std::string::npos) << ended.err;
    EXPECT_GT(pictures("x.mp4").size(), 30 * kGrey);
}

TEST_F(Record, refuses_what_it_cannot_write_before_it_plays) {
    write_clicks("clicks.wav", 1.0);
    ASSERT_TRUE(write_file(path("x.mp4"), "precious"));
    expect_one_line(play({"--record", path("x.mp4")}), 1, "is there already");
    EXPECT_EQ(read_file(path("x.mp4"), 100).value(), "precious");
    expect_one_line(play({"--record", path("no/such/x.mp4")}), 1, "No such file");
    expect_one_line(play({"--record", path("x.xyz")}), 1, "unknown kind of film");
    expect_one_line({"play",
                     path("clicks.wav"),
                     "--no-sound",
                     "--headless",
                     "--record",
                     path("y.mp4"),
                     "--size",
                     "161x97"},
                    1,
                    "must be even");
}

}  // namespace
}  // namespace raks::test
