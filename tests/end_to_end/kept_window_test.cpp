// What a window was last time, over several runs of the program.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/window.hpp"
#include "tests/support/file_drop.hpp"
#include "tests/support/jack_server.hpp"
#include "tests/support/run_program.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

/// Without a size that is asked for.
class KeptWindow : public WindowTest {
 protected:
    [[nodiscard]] ProcessPlan as_it_was(const std::vector<std::string>& options = {}) const {
        std::vector<std::string> words = {
            "play", "--no-sound", "--no-overlay", path("one.wav"), "--quality", "fast"};
        words.insert(words.end(), options.begin(), options.end());
        ProcessPlan plan = this->plan(words);
        std::erase(plan.unset, "DISPLAY");
        plan.folder = folder_.path();
        return plan;
    }
    [[nodiscard]] fs::path memory() const { return folder_ / "state" / "raks" / "window.toml"; }
    [[nodiscard]] std::string kept() const { return read_file(memory()).value_or("nothing"); }
    void keep(const std::string& text) const {
        ASSERT_TRUE(make_folders(memory().parent_path()));
        ASSERT_TRUE(write_file(memory(), text));
    }
    /// Starts it, does this in the window, and quits.
    static ProcessResult run_window(const ProcessPlan& plan,
                                    const std::function<void(CapturedProcess&)>& use = nullptr) {
        CapturedProcess raks(plan);
        EXPECT_TRUE(raks.wait_for_output("one.wav")) << raks.output().err;
        if (use) {
            use(raks);
        }
        press({"q"});
        ProcessResult result = raks.wait();
        EXPECT_FALSE(result.timed_out);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result;
    }
    static void move_window(int x, int y, int width, int height) {
        run_program({"xdotool",
                     "search",
                     "--sync",
                     "--name",
                     "Raks",
                     "windowsize",
                     "--sync",
                     std::to_string(width),
                     std::to_string(height),
                     "windowmove",
                     "--sync",
                     std::to_string(x),
                     std::to_string(y)});
    }
    /// "X=120\nY=90\nWIDTH=500\nHEIGHT=300": what the screen says of the window.
    static std::string geometry() {
        const std::string said = run_program(
            {"xdotool", "search", "--sync", "--name", "Raks", "getwindowgeometry", "--shell"});
        const std::size_t begin = said.find("X=");
        return said.substr(begin, said.find("\nSCREEN") - begin);
    }
    /// Runs with a file that is of no use: one line says so, and it is left as it is.
    void expect_one_line_and_no_change(const std::string& part) {
        const ProcessResult result = run_window(as_it_was());
        EXPECT_EQ(count_of("window.toml", result.err), 1) << result.err;
        EXPECT_EQ(count_of(part, result.err), 1) << result.err;
    }
};

TEST_F(KeptWindow, opens_where_and_as_large_as_it_was) {
    run_window(as_it_was(), [](CapturedProcess&) {
        shows([](const auto&) { return true; });
        move_window(120, 90, 500, 300);
    });
    EXPECT_NE(kept().find("x = 120\ny = 90\n"), std::string::npos) << kept();
    EXPECT_NE(kept().find("width = 500\nheight = 300\n"), std::string::npos) << kept();
    const std::string as_left = kept();
    run_window(as_it_was(), [](CapturedProcess&) {
        EXPECT_EQ(geometry(), "X=120\nY=90\nWIDTH=500\nHEIGHT=300");
    });
    EXPECT_EQ(kept(), as_left);
    run_window(as_it_was({"--size", "400x200"}), [](CapturedProcess&) {
        EXPECT_EQ(geometry(), "X=120\nY=90\nWIDTH=400\nHEIGHT=200");
    });
    EXPECT_EQ(kept(), as_left) << "a size for one run is not that of the next";
}

TEST_F(KeptWindow, of_a_place_off_the_screen_comes_back_onto_it) {
    keep("[window]\nx = 5000\ny = -700\nmonitor = \"screen\"\nwidth = 500\nheight = 300\n");
    run_window(as_it_was(), [](CapturedProcess&) {
        EXPECT_EQ(geometry(), "X=460\nY=0\nWIDTH=500\nHEIGHT=300");
    });
}

TEST_F(KeptWindow, avatars_that_were_dropped_dance_again_and_gone_ones_are_told) {
    const std::string model = path("godette.vrm");
    fs::copy_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/Godette_vrm_v4.vrm", model);
    run_window(as_it_was(), [&](CapturedProcess& raks) {
        std::string id = run_program({"xdotool", "search", "--sync", "--name", "Raks"});
        id.erase(id.find('\n'));
        drop_files(id, {model});
        EXPECT_TRUE(raks.wait_for_output("avatar: Low-Poly Godette by SirRichard94"));
    });
    EXPECT_NE(kept().find("avatar = \"" + model + "\"\n"), std::string::npos) << kept();
    EXPECT_NE(run_window(as_it_was()).err.find("avatar: Low-Poly Godette"), std::string::npos);
    EXPECT_EQ(run_window(as_it_was({"--avatar", "mannequin"})).err.find("Godette"),
              std::string::npos)
        << "an option wins";
    EXPECT_NE(kept().find(model), std::string::npos) << "and is not kept";
    fs::remove(model);
    const std::string told = run_window(as_it_was()).err;
    EXPECT_EQ(count_of("godette.vrm: not there any more; the mannequin dances instead", told), 1)
        << told;
    ASSERT_TRUE(write_file(model, "no model at all"));
    const std::string broken = run_window(as_it_was()).err;
    EXPECT_EQ(count_of("; the mannequin dances instead", broken), 1) << broken;
}

TEST_F(KeptWindow, a_file_of_no_use_is_told_in_one_line_and_stays) {
    for (const std::string& text : {std::string("[window"),
                                    std::string("version = 2\n"),
                                    std::string("[window]\nx = 100\ny = 50\nshade = 0.5\n")}) {
        keep(text);
        expect_one_line_and_no_change("window.toml");
        EXPECT_EQ(kept(), text);
    }
    fs::resize_file(memory(), 100'000'000);
    expect_one_line_and_no_change("is larger than 1 MiB");
    EXPECT_EQ(fs::file_size(memory()), 100'000'000U);
    fs::remove(memory());
    fs::create_directory(memory());
    expect_one_line_and_no_change("window.toml");
    EXPECT_TRUE(fs::is_directory(memory()));
    fs::remove(memory());
    ASSERT_EQ(mkfifo(memory().c_str(), 0600), 0);
    expect_one_line_and_no_change("is not a plain file");
    EXPECT_TRUE(fs::is_fifo(memory()));
}

TEST_F(KeptWindow, works_and_forgets_where_nothing_can_be_kept) {
    ASSERT_TRUE(write_file(folder_ / "state", "a file, and no folder"));
    const ProcessResult result = run_window(as_it_was());
    EXPECT_EQ(result.err.find("state"), std::string::npos) << result.err;
    ProcessPlan homeless = as_it_was();
    std::erase_if(homeless.environment,
                  [](const auto& variable) { return variable.first == "XDG_STATE_HOME"; });
    homeless.unset.insert(homeless.unset.end(), {"HOME", "XDG_STATE_HOME"});
    EXPECT_EQ(run_window(homeless).err.find("HOME"), std::string::npos);
}

TEST_F(KeptWindow, is_not_looked_at_where_none_opens) {
    keep("[window");
    const ProcessResult result =
        run({"play", "--headless", "--no-sound", "--duration", "0.2", "--quit", path("one.wav")});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err.find("window.toml"), std::string::npos) << result.err;
    EXPECT_EQ(kept(), "[window");
}

TEST_F(KeptWindow, a_device_that_is_remembered_and_gone_is_left_out) {
    const JackServer jack;
    ASSERT_EQ(jack.problem(), "");
    keep("[audio]\ndevice = \"Scarlett\"\n");
    const auto listen = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words = {"-v", "live", "--duration", "1"};
        words.insert(words.end(), options.begin(), options.end());
        ProcessPlan plan = in_window(words);
        std::erase_if(plan.environment,
                      [](const auto& pair) { return pair.first == "JACK_DEFAULT_SERVER"; });
        return run_process(plan);
    };
    const ProcessResult result = listen({});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(count_of("Scarlett is not there now", result.err), 1) << result.err;
    EXPECT_EQ(count_of("listening to 'system' (JACK)", result.err), 1) << result.err;
    EXPECT_NE(kept().find("device = \"Scarlett\""), std::string::npos) << "it may come back";
    EXPECT_EQ(listen({"--device", "Scarlett"}).exit_code, 1) << "one that is asked for must be";
}

// A person's kdeglobals asks for it; no bus runs.
TEST_F(KeptWindow, is_calm_where_the_desktop_asks_for_it) {
    const std::string said = "the desktop asks for calm pictures";
    ASSERT_TRUE(write_file(path("config/kdeglobals"), "[KDE]\nAnimationDurationFactor=0\n"));
    EXPECT_EQ(count_of(said, run_window(as_it_was({"-v"})).err), 1);
    EXPECT_EQ(count_of(said, run_window(as_it_was({"-v", "--no-calm"})).err), 0);
    ASSERT_TRUE(make_folders(path("config/raks")));
    ASSERT_TRUE(write_file(path("config/raks/config.toml"), "[picture]\ncalm = false\n"));
    EXPECT_EQ(count_of(said, run_window(as_it_was({"-v"})).err), 0);
}

}  // namespace
}  // namespace raks::test
