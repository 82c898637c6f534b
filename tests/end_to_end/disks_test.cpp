// Disks that are full, may not be written or are slow: what cannot be written is said in one line
// and leaves nothing, and a dance goes on. Full and read-only ones are real file systems in memory,
// mounted where this process alone sees them; a slow one is injected by strace.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/child_process.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class Disks : public ProgramTest {
 protected:
    void SetUp() override {
        audio::MusicPlan music;
        music.style = audio::Style::drums;
        music.seconds = 4.0;
        write_music("song.wav", music);
        fs::create_directory(path("disk"));
    }
    [[nodiscard]] static bool may_mount() {
        return exit_code_of({"unshare", "-m", "mount", "-t", "tmpfs", "tmpfs", "/mnt"}) == 0;
    }
    /// What is done to the folder $0 before the program runs.
    static constexpr const char* kFull =
        "mount -t tmpfs -o size=16k tmpfs \"$0\" && mkdir \"$0/kept\" && "
        "{ cat /dev/zero > \"$0/fill\" 2> /dev/null; true; }";
    static constexpr const char* kReadOnly = "mount -t tmpfs -o ro tmpfs \"$0\"";

    /// Runs the program where the folder "disk" was prepared so; what lies on it afterwards follows
    /// on stdout.
    [[nodiscard]] ProcessResult run_on(const std::string& prepare,
                                       const std::vector<std::string>& arguments) const {
        ProcessPlan made = plan(arguments);
        const std::vector<std::string> around = {
            "unshare",
            "-m",
            "sh",
            "-c",
            prepare + " && { \"$@\"; code=$?; find \"$0\" -type f ! -name fill; exit $code; }",
            path("disk")};
        made.command.insert(made.command.begin(), around.begin(), around.end());
        // All that the program keeps lies there, too, but the dances that are solved already.
        for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"}) {
            made.environment.emplace_back(name, path("disk/kept"));
        }
        return run_process(made);
    }
    /// Commands that write a file onto the disk.
    [[nodiscard]] std::vector<std::vector<std::string>> writers() const {
        const std::string song = path("song.wav");
        return {{"synth", "clicks", "-o", path("disk/x.wav"), "--duration", "10"},
                {"dance", song, "-o", path("disk/x.bvh")},
                {"analyze", song, "--plot", path("disk/x.svg")},
                {"render", song, "-o", path("disk/x.mp4"), "--quality", "fast", "--size", "160x90"},
                {"config", "init"}};
    }
    void expect_refused(const std::string& prepare, const std::string& reason) const {
        for (const auto& command : writers()) {
            const ProcessResult result = run_on(prepare, command);
            EXPECT_EQ(result.exit_code, 1) << command.front() << ": " << result.err;
            EXPECT_TRUE(is_one_error_line(result.err)) << command.front() << ": " << result.err;
            EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
            EXPECT_EQ(result.out, "") << command.front() << " leaves that";
        }
    }
    /// The dance goes on to its end, and nothing is said but what plays, and how often a busy
    /// machine was late.
    void expect_danced(const ProcessResult& result) const {
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const std::string playing = "raks: playing " + path("song.wav") + "\n";
        EXPECT_EQ(result.err.substr(0, playing.size()), playing);
        const std::string rest = result.err.substr(std::min(playing.size(), result.err.size()));
        const bool is_of_losses = rest.starts_with("raks: while it ran: ") &&
                                  rest.find("not danced") == std::string::npos &&
                                  rest.find('\n') == rest.size() - 1;
        EXPECT_TRUE(rest.empty() || is_of_losses) << rest;
    }
    [[nodiscard]] std::vector<std::string> playing() const {
        return {"play", path("song.wav"), "--headless", "--no-sound", "--duration", "2"};
    }
};

TEST_F(Disks, a_full_one_is_said_in_one_line_and_nothing_is_left) {
    if (!may_mount()) {
        GTEST_SKIP() << "no right to mount";
    }
    expect_refused(kFull, "No space left on device");
}

TEST_F(Disks, one_that_fills_up_leaves_the_film_up_to_there_beside_the_one_that_was_there) {
    if (!may_mount()) {
        GTEST_SKIP() << "no right to mount";
    }
    const std::string filling =
        "mount -t tmpfs -o size=1m tmpfs \"$0\" && mkdir \"$0/kept\" && echo old > \"$0/x.avi\"";
    for (const std::string name : {"x.avi", "x"}) {
        const std::string stopped = name == "x" ? "disk/x.stopped" : "disk/x.stopped.avi";
        const ProcessResult result = run_on(filling,
                                            {"render",
                                             path("song.wav"),
                                             "-o",
                                             path("disk/" + name),
                                             "--quality",
                                             "fast",
                                             "--size",
                                             "640x360"});
        EXPECT_EQ(result.exit_code, 1) << result.err;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("No space left on device; the "), std::string::npos)
            << result.err;
        EXPECT_NE(result.err.find(" in " + path(stopped) + "\n"), std::string::npos) << result.err;
        EXPECT_NE(result.out.find(path("disk/x.avi\n")), std::string::npos) << result.out;
        EXPECT_NE(result.out.find(path(stopped)), std::string::npos) << result.out;
        EXPECT_EQ(result.out.find(".part"), std::string::npos) << result.out;
    }
}

TEST_F(Disks, one_that_may_not_be_written_is_said_in_one_line) {
    if (!may_mount()) {
        GTEST_SKIP() << "no right to mount";
    }
    expect_refused(kReadOnly, "Read-only file system");
}

TEST_F(Disks, where_nothing_can_be_kept_it_dances_all_the_same) {
    if (!may_mount()) {
        GTEST_SKIP() << "no right to mount";
    }
    for (const char* prepare : {kFull, kReadOnly}) {
        expect_danced(run_on(prepare, playing()));
    }
}

/// A thread that must never wait for a disk.
bool is_realtime(const std::string& line) {
    return line.find("<raks-audio>") != std::string::npos ||
           line.find("<raks-motion>") != std::string::npos;
}

TEST_F(Disks, a_slow_one_holds_up_neither_sound_nor_dance) {
    if (exit_code_of({"strace", "-Y", "-o", "/dev/null", "true"}) != 0) {
        GTEST_SKIP() << "strace is not there, or may not trace";
    }
    // Everything that touches a disk takes half a second, in every thread; the dances are solved
    // anew and kept.
    constexpr const char* kOfDisks =
        "open,openat,creat,read,pread64,readv,write,pwrite64,writev,fsync,fdatasync,ftruncate,"
        "rename,linkat,unlink,mkdir,stat,newfstatat,statx,access";
    ProcessPlan made = plan(playing());
    made.environment.emplace_back("XDG_CACHE_HOME", path("disk/cache"));
    const std::string log = path("trace");
    const std::vector<std::string> strace = {"strace",
                                             "-f",
                                             "-Y",
                                             "--seccomp-bpf",
                                             "-o",
                                             log,
                                             "-e",
                                             std::string("trace=") + kOfDisks,
                                             "-e",
                                             "inject=fsync,linkat,rename,mkdir:delay_exit=500000"};
    made.command.insert(made.command.begin(), strace.begin(), strace.end());
    expect_danced(run_process(made));
    std::istringstream lines(read_file(log).value());
    int others = 0;
    for (std::string line; std::getline(lines, line);) {
        const bool is_end = line.find("+++ exited") != std::string::npos;
        EXPECT_FALSE(is_realtime(line) && !is_end) << line;
        ++others;
    }
    EXPECT_GT(others, 0);
    EXPECT_FALSE(fs::is_empty(path("disk/cache/raks/dances")));
}

}  // namespace
}  // namespace raks::test
