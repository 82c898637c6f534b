// Where the program's own files go, how much it says, and what it does where a place is missing.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>

#include "audio/io/audio_file.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/run_program.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class Places : public ProgramTest {
 protected:
    /// With other variables, and without some.
    [[nodiscard]] ProcessPlan plan_with(std::vector<std::string> words,
                                        const std::vector<std::pair<std::string, std::string>>& set,
                                        const std::vector<std::string>& unset = {}) const {
        ProcessPlan changed = plan(std::move(words));
        changed.environment.insert(changed.environment.end(), set.begin(), set.end());
        std::erase_if(changed.environment, [&](const auto& pair) {
            return std::find(unset.begin(), unset.end(), pair.first) != unset.end();
        });
        changed.unset.insert(changed.unset.end(), unset.begin(), unset.end());
        changed.folder = folder_.path().string();
        return changed;
    }
};

TEST_F(Places, without_a_home_no_settings_are_written_anywhere) {
    for (const char* const action : {"init", "path"}) {
        const ProcessResult result =
            run_process(plan_with({"config", action}, {}, {"HOME", "XDG_CONFIG_HOME"}));
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("set HOME or XDG_CONFIG_HOME"), std::string::npos);
    }
    EXPECT_EQ(files(), std::vector<std::string>{});
    const ProcessResult shown =
        run_process(plan_with({"config", "show"}, {}, {"HOME", "XDG_CONFIG_HOME"}));
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
}

TEST_F(Places, the_demo_needs_no_cache_that_can_be_written) {
    ASSERT_TRUE(write_file(path("file"), "x"));
    fs::create_directory(folder_ / "tmp");
    const ProcessResult result =
        run_process(plan_with({"render",
                               "-o",
                               path("x.avi"),
                               "--duration",
                               "0.2",
                               "--size",
                               "64x64",
                               "--quality",
                               "fast",
                               "--dance",
                               "salsa"},
                              {{"XDG_CACHE_HOME", path("file") + "/x"}, {"TMPDIR", path("tmp")}}));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::exists(path("x.avi")));
}

TEST_F(Places, models_that_are_missing_are_said_by_name) {
    fs::create_directory(folder_ / "bin");
    fs::copy_file(RAKS_PROGRAM, folder_ / "bin" / "raks");
    write_clicks("a.wav", 1.0);
    ProcessPlan alone =
        plan({"play", path("a.wav"), "--headless", "--no-sound", "--dance", "salsa"});
    alone.command.front() = path("bin/raks");
    const ProcessResult result = run_process(alone);
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("is not installed beside the program"), std::string::npos)
        << result.err;
}

TEST_F(Places, a_signal_ends_the_loading_at_once) {
    write_clicks("a.wav", 1.0);
    // Nothing is solved yet in a cache of its own: loading takes long.
    ProcessPlan loading = plan_with({"-v", "dance", path("a.wav"), "-o", path("x.bvh")},
                                    {{"XDG_CACHE_HOME", path("empty")}});
    CapturedProcess raks(loading);
    ASSERT_TRUE(raks.wait_for_output("loading the dances"));
    raks.send(SIGINT);
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_FALSE(fs::exists(path("x.bvh"))) << "it did not go on to dance";
}

TEST_F(Places, a_form_is_played_and_its_events_are_written) {
    const ProcessResult result = run({"synth",
                                      "drums",
                                      "-o",
                                      path("a.wav"),
                                      "--form",
                                      "full:8,breakdown:8,stop:4,drop:8,ending:4",
                                      "--events",
                                      path("a.events"),
                                      "--duration",
                                      "20"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_file(path("a.events")).value(),
              "0.000000\tentry\n4.000000\tbreakdown\n8.000000\tstop\n10.000000\tdrop\n"
              "14.000000\tend\n");
    const ProcessResult wrong = run({"synth", "drums", "-o", path("b.wav"), "--form", "songs"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(wrong.err)) << wrong.err;
    EXPECT_FALSE(fs::exists(path("b.wav")));
    ASSERT_EQ(run({"synth", "--form", "song", "-o", path("c.wav"), "--events", path("c.events")})
                  .exit_code,
              0);
    EXPECT_NE(read_file(path("c.events")).value().find("drop"), std::string::npos);
}

TEST_F(Places, music_of_our_own_comes_with_its_beats_and_the_tempo_of_its_style) {
    for (const auto& [style, seconds_a_beat, bar] :
         {std::tuple{"waltz", 60.0 / 140.0, 3}, std::tuple{"clicks", 0.5, 4}}) {
        const ProcessResult result = run(
            {"synth", style, "-o", path("a.wav"), "--beats", path("a.beats"), "--duration", "10"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        std::istringstream lines(read_file(path("a.beats")).value());
        double time = 0.0;
        int position = 0;
        int count = 0;
        for (; lines >> time >> position; ++count) {
            EXPECT_NEAR(time, count * seconds_a_beat, 1e-5) << style;
            EXPECT_EQ(position, 1 + count % bar) << style;
        }
        EXPECT_NEAR(count, 10.0 / seconds_a_beat, 1.0) << style;
    }
}

TEST_F(Places, quiet_says_what_went_wrong_alone_and_verbose_more) {
    write_clicks("a.wav", 0.5);
    const std::vector<std::string> words = {
        "play", path("a.wav"), "--headless", "--no-sound", "--dance", "salsa"};
    const auto with = [&](const std::string& option) {
        std::vector<std::string> all = words;
        all.insert(all.begin(), option);
        return run(all);
    };
    EXPECT_EQ(with("-q").err, "");
    std::vector<std::string> behind = words;
    behind.emplace_back("--quiet");
    EXPECT_EQ(run(behind).err, "");
    EXPECT_NE(with("-v").err.find("loading the dances"), std::string::npos);
    EXPECT_EQ(run(words).err.find("loading the dances"), std::string::npos);
    expect_one_line({"-q", "analyze", path("no.wav")}, 1, "no.wav");
}

// Packages of one distribution have an FFmpeg with x264, those of another none: whoever asks is
// told of the one that films are written with here.
TEST_F(Places, the_version_says_what_it_is_made_of_and_under_which_licence_it_is) {
    const ProcessResult whole = run({"-V"});
    EXPECT_EQ(whole.exit_code, 0);
    EXPECT_TRUE(whole.out.starts_with("raks 0.")) << whole.out;
    for (const char* line : {"\ncommit    ", "\ncompiler  ", "\nPipeWire  "}) {
        EXPECT_NE(whole.out.find(line), std::string::npos) << line << "in\n" << whole.out;
    }
    const std::string ffmpeg = run_program({"ffmpeg", "-version"});
    const std::string release = ffmpeg.substr(0, ffmpeg.find(' ', sizeof "ffmpeg version"));
    EXPECT_NE(whole.out.find("\nFFmpeg    " + release.substr(sizeof "ffmpeg version") + "\n"),
              std::string::npos)
        << whole.out;
    EXPECT_NE(whole.out.find("\nlicence   GPL version "), std::string::npos) << whole.out;

    ProcessPlan without = plan({"--version"});
    without.environment.emplace_back("RAKS_FILM_MODULE", path("no.so"));
    without.environment.emplace_back("RAKS_PIPEWIRE_MODULE", path("no.so"));
    const ProcessResult less = run_process(without);
    EXPECT_NE(less.out.find("\nFFmpeg    none"), std::string::npos) << less.out;
    EXPECT_NE(less.out.find("\nPipeWire  none"), std::string::npos) << less.out;
    EXPECT_EQ(less.out.find("GPL"), std::string::npos) << less.out;
}

TEST_F(Places, a_film_has_no_overlay_unless_it_is_asked_for) {
    write_clicks("a.wav", 1.0);
    const auto film = [&](const std::string& name, const std::string& option) {
        std::vector<std::string> words = {"render",
                                          path("a.wav"),
                                          "-o",
                                          path(name),
                                          "--size",
                                          "320x320",
                                          "--fps",
                                          "2",
                                          "--quality",
                                          "fast",
                                          "--dance",
                                          "salsa"};
        if (!option.empty()) {
            words.push_back(option);
        }
        const ProcessResult result = run(words);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_file(path(name) + "/000002.png").value_or("");
    };
    const std::string usual = film("usual", "");
    EXPECT_EQ(film("bare", "--no-overlay"), usual);
    EXPECT_NE(film("covered", "--overlay"), usual);
}

}  // namespace
}  // namespace raks::test
