// What reaches the terminal where libraries get into trouble: one line of ours, none of theirs.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

class Terminal : public ProgramTest {};

TEST_F(Terminal, settings_of_alsa_that_cannot_be_used_are_one_line) {
    write_clicks("song.wav", 1.0);
    ASSERT_TRUE(write_file(path("empty.conf"), ""));
    ASSERT_TRUE(write_file(path("broken.conf"), "pcm.!default { type hw\n@foo bar {\n"));
    const std::vector<std::vector<std::string>> commands = {
        {"devices"}, {"play", path("song.wav"), "--headless"}, {"live", "--headless"}};
    for (const char* name : {"missing.conf", "empty.conf", "broken.conf"}) {
        for (const auto& command : commands) {
            ProcessPlan made = plan(command);
            made.environment.emplace_back("ALSA_CONFIG_PATH", path(name));
            const ProcessResult result = run_process(made);
            EXPECT_EQ(result.exit_code, 1) << command.front() << " " << name;
            EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
            EXPECT_NE(result.err.find("ALSA's settings (" + path(name) + ")"), std::string::npos)
                << result.err;
        }
    }
}

TEST_F(Terminal, displays_that_are_not_there_are_one_line) {
    write_clicks("song.wav", 1.0);
    for (const char* display : {":9797", "nonsense:0", "", "localhost:9797"}) {
        ProcessPlan made = plan({"play", path("song.wav"), "--no-sound"});
        made.unset = {"WAYLAND_DISPLAY"};
        made.environment.emplace_back("DISPLAY", display);
        const ProcessResult result = run_process(made);
        EXPECT_EQ(result.exit_code, 1) << display;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("no display"), std::string::npos) << result.err;
    }
}

// From too little to start up to what is enough.
TEST_F(Terminal, too_little_memory_is_one_line) {
    write_clicks("song.wav", 1.0);
    const std::string dance = std::string(RAKS_SOURCE_DIR) + "/config/choreographies/waltz.toml";
    const std::vector<std::vector<std::string>> commands = {
        {"stick", dance, "--figure", "balance", "-o", path("x.png")},
        {"render", path("song.wav"), "-o", path("x.mp4"), "--quality", "fast", "--size", "64x36"},
        {"synth", "clicks", "-o", path("x.wav"), "--duration", "5"}};
    for (const auto& command : commands) {
        for (const long megabytes : {70, 100, 140, 200, 280, 400, 560}) {
            SCOPED_TRACE(command.front() + " " + std::to_string(megabytes));
            ProcessPlan made = plan(command);
            made.address_space_limit = megabytes << 20;
            const ProcessResult result = run_process(made);
            EXPECT_FALSE(result.timed_out);
            if (result.exit_code != 0) {
                EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
            }
        }
    }
}

}  // namespace
}  // namespace raks::test
