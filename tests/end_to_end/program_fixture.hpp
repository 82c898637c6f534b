#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "tests/support/process.hpp"
#include "tests/support/shared_caches.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::test {

/// A folder of this test alone, removed at its end, and the program `raks` started in a clean
/// environment: no settings of the user, no display, no audio server.
class ProgramTest : public ::testing::Test {
 protected:
    ProgramTest() { share_solved_dances(folder_ / "cache", "raks"); }

    [[nodiscard]] ProcessPlan plan(std::vector<std::string> arguments) const {
        ProcessPlan plan;
        plan.command = {RAKS_PROGRAM};
        plan.command.insert(plan.command.end(), arguments.begin(), arguments.end());
        plan.environment = {{"XDG_CONFIG_HOME", (folder_ / "config").string()},
                            {"XDG_CACHE_HOME", (folder_ / "cache").string()},
                            {"XDG_DATA_HOME", (folder_ / "share").string()},
                            {"XDG_STATE_HOME", (folder_ / "state").string()},
                            {"JACK_NO_START_SERVER", "1"},
                            {"JACK_DEFAULT_SERVER", "raks_none"},
                            {"PULSE_SERVER", "unix:" + (folder_ / "no_pulse").string()},
                            {"LIBGL_ALWAYS_SOFTWARE", "1"}};
        plan.unset = {"DISPLAY", "WAYLAND_DISPLAY", "DBUS_SESSION_BUS_ADDRESS"};
        return plan;
    }
    [[nodiscard]] ProcessResult run(std::vector<std::string> arguments) const {
        return run_process(plan(std::move(arguments)));
    }
    [[nodiscard]] std::string path(const std::string& name) const {
        return (folder_ / name).string();
    }
    /// The user's settings ask for small pictures, where how much is drawn does not matter.
    void draw_small_pictures() const;
    /// Music by the generator as 16-bit WAV.
    audio::GeneratedMusic write_music(const std::string& name, const audio::MusicPlan& plan) const;
    void write_clicks(const std::string& name, double seconds = 3.0) const;

    /// The program ends so, says one line with `part` in it, and prints nothing.
    void expect_one_line(const std::vector<std::string>& arguments,
                         int exit_code,
                         const std::string& part) const;

    /// Names of what lies in the test's folder, sorted, without the program's own cache.
    [[nodiscard]] std::vector<std::string> files() const;

    TemporaryFolder folder_;
};

/// Exactly one line, starting with "raks: ".
[[nodiscard]] bool is_one_error_line(const std::string& text);

}  // namespace raks::test
