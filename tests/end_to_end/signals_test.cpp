// A person, a closed terminal or the system tells the program to end. RAKS_SIGNALS=100 sends so
// many of each kind at random moments, and measures how long the end takes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.hpp"
#include "base/random.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/extent.hpp"

#include <fmt/format.h>

namespace raks::test {
namespace {

const std::string kSoundfont =
    std::string(RAKS_SOURCE_DIR) + "/tests/fuzz/corpus/soundfont/tiny.sf2";

/// What a process has computed so far.
double cpu_seconds(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    // Behind the name, which may hold anything, user and system time are the 12th and 13th.
    std::istringstream words(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::vector<std::string> all((std::istream_iterator<std::string>(words)), {});
    return all.size() < 13 ? 0.0
                           : (std::stod(all[11]) + std::stod(all[12])) /
                                 static_cast<double>(sysconf(_SC_CLK_TCK));
}

class Signals : public ProgramTest {
 protected:
    /// Commands that would run for many seconds.
    [[nodiscard]] std::vector<std::vector<std::string>> long_commands() const {
        std::vector<std::vector<std::string>> commands = {
            {"synth", "salsa", "-o", path("x.wav"), "--duration", "3600"},
            {"stick", path("tango.toml"), "-o", path("x.png")},
            {"eval", "dance"},
            {"bench", "analysis", "--duration", "600"},
            {"play", path("song.wav"), "--headless", "--no-sound"},
            // Of the programs that raks starts in its place.
            {"train",
             "genre",
             "--synthesize",
             "2000",
             "--soundfont",
             kSoundfont,
             "-o",
             path("x.json")}};
        if (!std::string_view(RAKS_CAPTURE_PROGRAM).empty()) {
            const std::filesystem::path clip = std::filesystem::path(RAKS_SOURCE_DIR) / "tests" /
                                               "data" / "bvh" / "dance" / "own_dance.bvh";
            commands.push_back({"capture", "simulate", clip.string(), "-o", path("capture")});
        }
        return commands;
    }
    void SetUp() override {
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.seconds = 60.0;
        write_music("song.wav", plan);
        std::filesystem::copy_file(
            std::filesystem::path(RAKS_SOURCE_DIR) / "config" / "choreographies" / "waltz.toml",
            path("tango.toml"));
    }
};

TEST_F(Signals, end_every_command_with_their_code_and_leave_nothing_half_written) {
    const std::vector<std::string> before = files();
    for (const int signal : {SIGTERM, SIGHUP}) {
        for (const std::vector<std::string>& command : long_commands()) {
            SCOPED_TRACE(command.front());
            CapturedProcess raks(plan(command));
            // Some say nothing while they work.
            ASSERT_TRUE(raks.wait_until(
                [&](const ProcessResult&) { return cpu_seconds(raks.pid()) > 0.3; }));
            raks.send(signal);
            const ProcessResult result = raks.wait();
            EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
            EXPECT_FALSE(result.timed_out);
        }
    }
    EXPECT_EQ(files(), before);
}

/// Stops all decoders of the program, as if they hung.
void stop_decoders(pid_t program) {
    for (const pid_t child : children_of(program)) {
        ::kill(child, SIGSTOP);
    }
}

TEST_F(Signals, do_not_wait_for_decoders_that_hang) {
    for (const int signal : {SIGTERM, SIGINT}) {
        CapturedProcess raks(plan({"play", path("song.wav"), "--headless", "--no-sound"}));
        ASSERT_TRUE(raks.wait_for_output("playing"));
        ASSERT_FALSE(children_of(raks.pid()).empty());
        stop_decoders(raks.pid());
        raks.send(signal);
        const ProcessResult result = raks.wait();
        EXPECT_EQ(result.exit_code, 128 + signal);
        EXPECT_EQ(result.err.find("hung"), std::string::npos) << result.err;
    }
}

TEST_F(Signals, end_every_command_within_a_second_at_any_moment) {
    const auto count = number_from("RAKS_SIGNALS");
    if (!count) {
        GTEST_SKIP() << "RAKS_SIGNALS=100 in the environment runs it: it takes minutes";
    }
    using Clock = std::chrono::steady_clock;
    const CounterRandom random(1);
    std::uint64_t drawn = 0;
    const auto commands = long_commands();
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        Clock::duration longest{};
        for (std::int64_t i = 0; i < *count; ++i) {
            const auto& command = commands[static_cast<std::size_t>(i) % commands.size()];
            // From before the program has looked at its arguments up to the middle of the work.
            const double moment = 1e-3 * static_cast<double>(random.below(drawn++, 1'000));
            SCOPED_TRACE(fmt::format("{} at {} s", command.front(), moment));
            CapturedProcess raks(plan(command));
            ASSERT_TRUE(raks.wait_until(
                [&](const ProcessResult&) { return cpu_seconds(raks.pid()) >= moment; }));
            const auto sent = Clock::now();
            raks.send(signal);
            const ProcessResult result = raks.wait();
            longest = std::max(longest, Clock::now() - sent);
            EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
        }
        const double seconds = std::chrono::duration<double>(longest).count();
        std::cout << fmt::format("{}: at most {:.2f} s\n", strsignal(signal), seconds);
        EXPECT_LE(seconds, 1.0);
    }
}

TEST_F(Signals, a_film_that_was_stopped_lies_beside_the_one_that_was_there) {
    std::ofstream(path("x.mp4")) << "an older film";
    CapturedProcess raks(plan({"render",
                               path("song.wav"),
                               "-o",
                               path("x.mp4"),
                               "--quality",
                               "fast",
                               "--size",
                               "128x72",
                               "--as-live",
                               "-v"}));
    ASSERT_TRUE(raks.wait_until([&](const ProcessResult&) {
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
            if (entry.path().extension() == ".part" && entry.file_size() > 20'000) {
                return true;
            }
        }
        return false;
    }));
    raks.send(SIGTERM);
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 143);
    EXPECT_NE(result.err.find("x.stopped.mp4 holds the first "), std::string::npos) << result.err;
    EXPECT_EQ(read_file(path("x.mp4")).value(), "an older film");
    EXPECT_TRUE(std::filesystem::exists(path("x.stopped.mp4")));
}

TEST_F(Signals, a_dance_that_was_stopped_lies_beside_the_one_that_was_there) {
    std::ofstream(path("x_1.bvh")) << "an older dance";
    ProcessResult result;
    // Before it dances nothing is left; some moment later it has danced.
    for (double moment = 0.4; !std::filesystem::exists(path("x_1.stopped.bvh")); moment += 0.1) {
        CapturedProcess raks(plan({"dance",
                                   path("song.wav"),
                                   "--as-live",
                                   "--dancers",
                                   "6",
                                   "--formation",
                                   "unison",
                                   "-o",
                                   path("x.bvh")}));
        ASSERT_TRUE(raks.wait_until([&](const ProcessResult&) {
            return cpu_seconds(raks.pid()) >= moment;
        })) << "it never danced";
        raks.send(SIGINT);
        result = raks.wait();
        ASSERT_EQ(result.exit_code, 130) << result.err;
        EXPECT_EQ(read_file(path("x_1.bvh")).value(), "an older dance");
    }
    EXPECT_NE(result.err.find("x_6.stopped.bvh hold the first "), std::string::npos) << result.err;
}

}  // namespace
}  // namespace raks::test
