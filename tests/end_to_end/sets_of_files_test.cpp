// Folders, playlists and pipes, as a person gives them to `play` and `analyze`.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;
using NameList = std::vector<std::string>;

class SetsOfFiles : public ProgramTest {
 protected:
    /// A second of clicks under that name.
    void make(const std::string& name) const {
        fs::create_directories(fs::path(path(name)).parent_path());
        write_clicks(name, 0.6);
    }
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories(fs::path(path(name)).parent_path());
        ASSERT_TRUE(write_file(path(name), bytes));
    }
    [[nodiscard]] ProcessResult play(std::vector<std::string> words) const {
        words.insert(words.begin(), "play");
        words.insert(words.end(), {"--headless", "--no-sound"});
        return run(std::move(words));
    }
    /// What was played, in order, as this test names it.
    [[nodiscard]] NameList played(const ProcessResult& result) const {
        NameList names;
        std::istringstream lines(result.err);
        const std::string begin = "raks: playing ";
        const std::string folder = folder_.path().string() + "/";
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with(begin)) {
                const std::string name = line.substr(begin.size());
                names.push_back(name.starts_with(folder) ? name.substr(folder.size()) : name);
            }
        }
        return names;
    }
    /// The program with the shell's words before it.
    [[nodiscard]] ProcessResult run_in_shell(const std::string& script) const {
        ProcessPlan shell = plan({});
        shell.command = {"/bin/sh", "-c", script, RAKS_PROGRAM};
        shell.folder = folder_.path().string();
        return run_process(shell);
    }
};

TEST_F(SetsOfFiles, a_stick_as_macos_leaves_it_plays_its_music_alone) {
    make("album/01.wav");
    make("album/CD 10/02.wav");
    make("album/CD 2/02.wav");
    write("album/._01.wav", std::string("\0\5\x16\7", 4));
    write("album/cover.jpg", "picture");
    const ProcessResult result = play({path("album")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(played(result),
              (NameList{"album/01.wav", "album/CD 2/02.wav", "album/CD 10/02.wav"}));
}

TEST_F(SetsOfFiles, what_is_broken_is_skipped_wherever_it_stands_and_said_at_the_end) {
    write("m/1.mp3", "no music\n");
    make("m/2.wav");
    write("m/3.wav", "");
    make("m/4.wav");
    write("m/5.ogg", "OggS");
    const ProcessResult result = play({path("m")});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_EQ(played(result), (NameList{"m/2.wav", "m/4.wav"}));
    const std::size_t report = result.err.find("raks: 3 skipped:");
    ASSERT_NE(report, std::string::npos) << result.err;
    for (const char* const name : {"1.mp3: is not audio", "3.wav: is empty", "5.ogg: "}) {
        EXPECT_NE(result.err.find(name, report), std::string::npos) << result.err;
    }
    for (const char* const name : {"1.mp3", "3.wav", "5.ogg"}) {
        fs::rename(path("m/") + name, path("m/") + name + ".wav");
    }
    fs::remove(path("m/2.wav"));
    fs::remove(path("m/4.wav"));
    expect_one_line(
        {"play", path("m"), "--headless"}, 1, "(and 2 more; none of the files can be played)");
}

TEST_F(SetsOfFiles, a_playlist_plays_its_entries_and_says_which_are_not_there) {
    make("a.wav");
    make("sub/b.wav");
    write("list.m3u", "#EXTM3U\nsub/b.wav\ngone.wav\nhttp://x.org/c.mp3\nlist.m3u\na.wav\n");
    const ProcessResult result = play({path("list.m3u")});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_EQ(played(result), (NameList{"sub/b.wav", "a.wav"}));
    EXPECT_NE(result.err.find("gone.wav: is not there (named by list.m3u)"), std::string::npos);
    EXPECT_NE(result.err.find("http://x.org/c.mp3: is an address in the network"),
              std::string::npos);
    expect_one_line({"play", "https://x.org/a.mp3"}, 1, "is an address in the network");
}

TEST_F(SetsOfFiles, shuffled_they_come_in_an_order_of_the_seed) {
    NameList all;
    for (const char* const name : {"1.wav", "2.wav", "3.wav", "4.wav", "5.wav"}) {
        make(std::string("m/") + name);
        all.push_back(std::string("m/") + name);
    }
    const NameList first = played(play({path("m"), "--shuffle", "--seed", "3"}));
    EXPECT_NE(first, all);
    EXPECT_EQ(played(play({path("m"), "--shuffle", "--seed", "3"})), first);
    NameList sorted = first;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, all);
}

TEST_F(SetsOfFiles, repeated_they_begin_anew_until_somebody_stops_them) {
    make("m/1.wav");
    make("m/2.wav");
    CapturedProcess raks(
        plan({"play", path("m"), "--repeat", "--headless", "--no-sound", "--dance", "salsa"}));
    ASSERT_TRUE(
        raks.wait_until([&](const ProcessResult& so_far) { return played(so_far).size() >= 4; }));
    raks.send(SIGINT);
    const ProcessResult result = raks.wait();
    EXPECT_EQ(result.exit_code, 130) << result.err;
    NameList names = played(result);
    names.resize(4);
    EXPECT_EQ(names, (NameList{"m/1.wav", "m/2.wav", "m/1.wav", "m/2.wav"}));
}

TEST_F(SetsOfFiles, a_start_behind_the_end_is_an_error_and_no_silence) {
    make("a.wav");
    expect_one_line({"play", path("a.wav"), "--headless", "--start", "9"},
                    1,
                    "a.wav: is 0.6 s long; it cannot start at 9 s");
    write_clicks("long.wav", 3.0);
    const ProcessResult result = play({path("a.wav"), path("long.wav"), "--start", "2.5"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_EQ(played(result), NameList{"long.wav"});
}

TEST_F(SetsOfFiles, a_pipe_is_played_and_analyzed_to_its_end) {
    make("a.wav");
    const ProcessResult result = run_in_shell("cat a.wav | \"$0\" play - --headless --no-sound");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(played(result), NameList{"standard input"});
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const ProcessResult analyzed = run_in_shell("cat a.wav > pipe & \"$0\" analyze pipe --json");
    EXPECT_EQ(analyzed.exit_code, 0) << analyzed.err;
    EXPECT_NEAR(nlohmann::json::parse(analyzed.out)["duration"].get<double>(), 0.6, 0.01);
}

TEST_F(SetsOfFiles, a_pipe_without_a_writer_or_sound_is_said) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    expect_one_line({"play", path("pipe"), "--headless"}, 1, "nobody writes to this pipe");
    const ProcessResult text = run_in_shell("echo no sound | \"$0\" play - --headless");
    EXPECT_EQ(text.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(text.err)) << text.err;
    const ProcessResult late = run_in_shell("echo no sound | \"$0\" play - --headless --start 3");
    EXPECT_NE(late.err.find("leave --start out"), std::string::npos) << late.err;
}

TEST_F(SetsOfFiles, whoever_waits_for_a_pipe_can_stop) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    CapturedProcess raks(plan({"-v", "analyze", path("pipe")}));
    ASSERT_TRUE(raks.wait_for_output("waiting for the pipe"));
    raks.send(SIGINT);
    EXPECT_EQ(raks.wait().exit_code, 130);
}

TEST_F(SetsOfFiles, several_files_are_analyzed_into_one_document) {
    make("m/1.wav");
    write("m/2.wav", "no music");
    make("m/10.wav");
    const ProcessResult json = run({"analyze", path("m"), "--json"});
    EXPECT_EQ(json.exit_code, 3) << json.err;
    const auto document = nlohmann::json::parse(json.out);
    EXPECT_EQ(document["format"], "raks-analyses");
    EXPECT_EQ(document["version"], 1);
    ASSERT_EQ(document["files"].size(), 2U);
    EXPECT_EQ(document["files"][0]["format"], "raks-analysis");
    EXPECT_EQ(document["files"][0]["file"], path("m/1.wav"));
    EXPECT_EQ(document["files"][1]["file"], path("m/10.wav"));
    EXPECT_EQ(document["skipped"], 1);
    const ProcessResult text = run({"analyze", path("m/1.wav"), path("m/10.wav")});
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_LT(text.out.find("m/1.wav: 0.6 s"), text.out.find("m/10.wav: 0.6 s"));
    expect_one_line({"analyze", path("m"), "--plot", path("x.svg")}, 1, "a plot shows one file");
}

TEST_F(SetsOfFiles, a_hundred_thousand_entries_that_are_not_there_are_one_short_report) {
    make("a.wav");
    std::string list = "a.wav\n";
    for (int i = 0; i < 100'000; ++i) {
        list += "gone/" + std::to_string(i) + "\n";
    }
    write("long.m3u8", list);
    const ProcessResult result = play({path("long.m3u8")});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find("100000 skipped:"), std::string::npos);
    EXPECT_LT(std::count(result.err.begin(), result.err.end(), '\n'), 40);
}

}  // namespace
}  // namespace raks::test
