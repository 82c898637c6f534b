// Every call that writes an output fails in turn, or is the last one of the process: the file that
// was there, or the new one, is there whole. Faults are injected by strace.
// RAKS_CRASH_POINTS=whole tries every call instead of the first of each kind, and a film, too.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "tests/end_to_end/program.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/extent.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

/// A command that writes one file.
struct Command {
    std::vector<std::string> words;
    std::string output;
};
/// How a call ends: as strace says it.
struct Fault {
    std::string call;
    std::string how;
};

class CrashPoints : public ProgramTest {
 protected:
    void SetUp() override {
        if (exit_code_of({"strace", "-o", "/dev/null", "true"}) != 0) {
            GTEST_SKIP() << "strace is not there, or may not trace";
        }
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.seconds = 2.0;
        write_music("song.wav", plan);
        // Kept dances and the like are written before, not while faults are injected.
        for (const Command& command : commands()) {
            EXPECT_EQ(run(command.words).exit_code, 0);
            fs::remove(command.output);
        }
    }
    [[nodiscard]] std::vector<Command> commands() const {
        const std::string song = path("song.wav");
        const std::string settings = path("config/raks/config.toml");
        std::vector<Command> all = {
            {{"synth", "clicks", "-o", path("x.wav"), "--duration", "1"}, path("x.wav")},
            {{"dance", song, "-o", path("x.bvh")}, path("x.bvh")},
            {{"analyze", song, "--plot", path("x.svg")}, path("x.svg")},
            {{"config", "init"}, settings}};
        if (is_whole("RAKS_CRASH_POINTS")) {
            all.push_back(
                {{"render", song, "-o", path("x.mp4"), "--quality", "fast", "--size", "160x90"},
                 path("x.mp4")});
        }
        return all;
    }
    /// Runs it with the fault at the call number `when`; true when the call came that often.
    [[nodiscard]] bool run_with(const Command& command,
                                const Fault& fault,
                                int when,
                                ProcessResult& result) const {
        ProcessPlan traced = plan(command.words);
        const std::string log = path("trace");
        const std::vector<std::string> strace = {
            "strace",
            "-f",
            "-o",
            log,
            "-e",
            "trace=" + fault.call,
            "-e",
            "inject=" + fault.call + ":" + fault.how + ":when=" + std::to_string(when)};
        traced.command.insert(traced.command.begin(), strace.begin(), strace.end());
        result = run_process(traced);
        const std::string trace = read_file(log).value_or("");
        fs::remove(log);
        return trace.find("INJECTED") != std::string::npos ||
               trace.find("killed by SIGKILL") != std::string::npos;
    }
    void expect_whole(const Command& command, const std::string& old, const std::string& made);
};

/// What lies there after a fault is one of the two, or nothing where nothing was.
void CrashPoints::expect_whole(const Command& command,
                               const std::string& old,
                               const std::string& made) {
    const std::string now = read_file(command.output).value_or("");
    EXPECT_TRUE(now == old || now == made) << now.size() << " bytes";
    const std::string output = fs::path(command.output).filename();
    // What a killed film holds so far is for the person to keep.
    const bool may_leave_part = output == "x.mp4";
    for (const auto& entry : fs::directory_iterator(fs::path(command.output).parent_path())) {
        const std::string name = entry.path().filename();
        if (entry.is_directory() || name == "song.wav" || name == output) {
            continue;
        }
        EXPECT_TRUE(may_leave_part) << name << " is left";
        fs::remove(entry.path());
    }
}

TEST_F(CrashPoints, leave_the_old_file_or_the_new_one_whole) {
    const std::vector<Fault> faults = {{"write", "error=ENOSPC"},
                                       {"write", "error=EIO"},
                                       {"fsync", "error=EIO"},
                                       {"linkat", "error=EIO"},
                                       {"rename", "error=EIO"},
                                       {"write", "signal=KILL"},
                                       {"fsync", "signal=KILL"},
                                       {"linkat", "signal=KILL"}};
    const int most_calls = is_whole("RAKS_CRASH_POINTS") ? 1000 : 1;  // of each kind
    int injected = 0;
    for (const Command& command : commands()) {
        ASSERT_EQ(run(command.words).exit_code, 0);
        const std::string made = read_file(command.output).value();
        for (const std::string& old : {std::string(), std::string("old")}) {
            for (const Fault& fault : faults) {
                for (int when = 1; when <= most_calls; ++when) {
                    SCOPED_TRACE(command.words.front() + " " + fault.call + " " + fault.how + " " +
                                 std::to_string(when) + (old.empty() ? "" : ", over a file"));
                    fs::remove(command.output);
                    if (!old.empty()) {
                        ASSERT_TRUE(write_file(command.output, old));
                    }
                    ProcessResult result;
                    if (!run_with(command, fault, when, result)) {
                        break;
                    }
                    ++injected;
                    expect_whole(command, old, made);
                    EXPECT_NE(result.exit_code, 139) << "no crash of its own";
                }
            }
        }
        fs::remove(command.output);
    }
    EXPECT_GT(injected, 30);
}

TEST_F(CrashPoints, an_interrupted_write_is_no_fault) {
    const Command command = commands()[1];
    ASSERT_EQ(run(command.words).exit_code, 0);
    const std::string made = read_file(command.output).value();
    for (int when = 1; when <= 3; ++when) {
        fs::remove(command.output);
        ProcessResult result;
        EXPECT_TRUE(run_with(command, {"write", "error=EINTR"}, when, result) || when > 1);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(read_file(command.output).value_or(""), made);
    }
}

}  // namespace
}  // namespace raks::test
