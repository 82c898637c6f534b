// Every call that writes an output fails in turn, or is the last one of the process: the file that
// was there, or the new one, is there whole, nothing else lies there, and the next run works.
// Faults are injected by strace. RAKS_CRASH_POINTS=whole tries every call instead of the first of
// each kind, and films and pictures, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/motion/choreography/small_dance.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/extent.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

/// Bytes of every file, by its path.
using Contents = std::map<std::string, std::string>;

/// A command, and the file or folder that it writes.
struct Command {
    std::vector<std::string> words;
    std::string output;
    std::string cache{};          ///< a folder of its own for what it keeps; empty: the usual one
    bool may_leave_part = false;  ///< what a killed film holds so far is for the person to keep
};
/// How a call ends: as strace says it.
struct Fault {
    std::string call;
    std::string how;
    int usual_calls = 1;  ///< so many are tried where not all are

    [[nodiscard]] bool kills() const { return how == "signal=KILL"; }
};

class CrashPoints : public ProgramTest {
 protected:
    void SetUp() override {
        if (exit_code_of({"strace", "-o", "/dev/null", "true"}) != 0) {
            GTEST_SKIP() << "strace is not there, or may not trace";
        }
        audio::MusicPlan music;
        music.style = audio::Style::drums;
        music.seconds = 2.0;
        write_music("song.wav", music);
        write_clip();
        write_small_dance();
    }
    /// A dance that is learnt and solved in no time.
    void write_small_dance() const {
        ASSERT_TRUE(write_file(path("small.toml"), motion::kSmallDance));
    }
    void write_clip() const {
        std::vector<motion::Pose> poses(200);
        for (std::size_t i = 0; i < poses.size(); ++i) {
            poses[i].hips_position.y = 0.9F + 0.001F * static_cast<float>(i % 20);
        }
        ASSERT_TRUE(motion::write_bvh(path("clip.bvh"), motion::mannequin_skeleton(), poses, 60.0));
        ASSERT_TRUE(write_file(path("labels.tsv"),
                               "take\trole\tstart\tend\tfigure\tbeats\n"
                               "clip\tlead\t10\t150\tbasic\t8\n"));
    }
    [[nodiscard]] std::vector<Command> commands() const;
    [[nodiscard]] ProcessPlan plan_of(const Command& command) const {
        ProcessPlan made = plan(command.words);
        if (!command.cache.empty()) {
            made.environment.emplace_back("XDG_CACHE_HOME", command.cache);
        }
        return made;
    }
    static void clear(const Command& command) {
        fs::remove_all(command.output);
        if (!command.cache.empty()) {
            fs::remove_all(command.cache);
        }
    }
    [[nodiscard]] static Contents contents_of(const fs::path& folder) {
        Contents all;
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            if (entry.is_regular_file()) {
                all[entry.path()] = read_file(entry.path()).value_or("");
            }
        }
        return all;
    }
    /// All that lies in the test's folder, but the dances that tests share.
    [[nodiscard]] Contents everything() const { return contents_of(folder_.path()); }
    /// Runs it with the fault at the call number `when`; true when the call came that often.
    [[nodiscard]] bool run_with(const Command& command,
                                const Fault& fault,
                                int when,
                                ProcessResult& result) const {
        ProcessPlan traced = plan_of(command);
        const std::string log = path("trace");
        std::vector<std::string> strace = {
            "strace",
            "-f",
            "-o",
            log,
            "-e",
            "trace=" + fault.call,
            "-e",
            "inject=" + fault.call + ":" + fault.how + ":when=" + std::to_string(when)};
        // It then stops at this call alone; strace 6.1 would kill nobody.
        if (!fault.kills()) {
            strace.insert(strace.begin() + 1, "--seccomp-bpf");
        }
        traced.command.insert(traced.command.begin(), strace.begin(), strace.end());
        result = run_process(traced);
        const std::string trace = read_file(log).value_or("");
        fs::remove(log);
        return trace.find("INJECTED") != std::string::npos || result.exit_code == 128 + SIGKILL;
    }
    void try_calls(const Command& command, const Fault& fault, bool is_over_file);
    void expect_whole(const Command& command, const Contents& before, bool was_killed);
    void expect_next_run_works(const Command& command);

    Contents made_;  // what lies there after an undisturbed run
    int injected_ = 0;
};

std::vector<Command> CrashPoints::commands() const {
    const std::string song = path("song.wav");
    std::vector<Command> all = {
        {{"synth", "clicks", "-o", path("x.wav"), "--duration", "1"}, path("x.wav")},
        {{"dance", song, "-o", path("x.bvh")}, path("x.bvh")},
        {{"analyze", song, "--plot", path("x.svg")}, path("x.svg")},
        {{"config", "init"}, path("config/raks/config.toml")},
        {{"train",
          "figure",
          path("clip.bvh"),
          "--labels",
          path("labels.tsv"),
          "--scale",
          "1",
          "-o",
          path("x.json")},
         path("x.json")},
        {{"train",
          "figure",
          path("small.toml"),
          "--figure",
          "rock_step",
          "--iterations",
          "0",
          "--states",
          "4",
          "-o",
          path("x/d")},
         path("x")},
        // The dance that it solves is kept.
        {{"dance", song, "--dance", "waltz", "-o", path("y.bvh")}, path("y.bvh"), path("fresh")}};
    if (is_whole("RAKS_CRASH_POINTS")) {
        for (const std::string name : {"x.mp4", "x.mkv", "pictures"}) {
            all.push_back({{"render",
                            song,
                            "-o",
                            path(name),
                            "--quality",
                            "fast",
                            "--size",
                            "64x36",
                            "--duration",
                            "0.3"},
                           path(name),
                           {},
                           true});
        }
        all.push_back(
            {{"stick", path("clip.bvh"), "--scale", "1", "-o", path("x.png")}, path("x.png")});
    }
    return all;
}

/// What lies there after a fault was there before, or is what the command makes.
void CrashPoints::expect_whole(const Command& command, const Contents& before, bool was_killed) {
    const Contents now = everything();
    for (const auto& [name, bytes] : before) {
        EXPECT_TRUE(now.contains(name)) << name << " is lost";
    }
    for (const auto& [name, bytes] : now) {
        const auto old = before.find(name);
        const auto made = made_.find(name);
        const bool is_whole = (old != before.end() && old->second == bytes) ||
                              (made != made_.end() && made->second == bytes);
        const bool is_part = name.ends_with(".part") || name.find(".part/") != std::string::npos;
        if (is_part && command.may_leave_part) {
            fs::remove_all(name);
            continue;
        }
        // Killed just before the rename: whole, and removed by the next run.
        const std::string target = name.substr(0, name.rfind(".raks.part"));
        const bool is_about_to_be_renamed =
            was_killed && ((name.ends_with(".raks.part") && made_.contains(target) &&
                            made_.at(target) == bytes) ||
                           name.find(".raks.part/") != std::string::npos);  // a folder's copy
        EXPECT_TRUE(is_whole || is_about_to_be_renamed) << name << ": " << bytes.size() << " bytes";
    }
}

void CrashPoints::expect_next_run_works(const Command& command) {
    const ProcessResult result = run_process(plan_of(command));
    // Settings that are there already are not written again, and this is said.
    EXPECT_TRUE(result.exit_code == 0 || command.words.front() == "config") << result.err;
    const Contents now = everything();
    for (const auto& [name, bytes] : now) {
        EXPECT_TRUE(made_.contains(name)) << name << " is left";
    }
}

void CrashPoints::try_calls(const Command& command, const Fault& fault, bool is_over_file) {
    const int most_calls = is_whole("RAKS_CRASH_POINTS") ? 1000 : fault.usual_calls;
    for (int when = 1; when <= most_calls; ++when) {
        SCOPED_TRACE(command.words.front() + " -> " + command.output + ": " + fault.call + " " +
                     fault.how + " " + std::to_string(when) +
                     (is_over_file ? ", over a file" : ""));
        clear(command);
        if (is_over_file) {
            ASSERT_TRUE(write_file(command.output, "old"));
        }
        const Contents before = everything();
        ProcessResult result;
        if (!run_with(command, fault, when, result)) {
            return;
        }
        ++injected_;
        EXPECT_NE(result.exit_code, 139) << "no crash of its own";
        expect_whole(command, before, fault.kills());
        if (fault.kills()) {
            expect_next_run_works(command);
        }
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
                                       {"linkat", "signal=KILL", 2},
                                       {"rename", "signal=KILL"}};
    // Dances that are kept and the like are written before, not while faults are injected.
    for (const Command& command : commands()) {
        const ProcessResult result = run_process(plan_of(command));
        EXPECT_EQ(result.exit_code, 0) << command.words.front() << ": " << result.err;
        clear(command);
    }
    for (const Command& command : commands()) {
        ASSERT_EQ(run_process(plan_of(command)).exit_code, 0);
        made_ = everything();
        const bool may_replace = fs::is_regular_file(command.output);
        for (const Fault& fault : faults) {
            try_calls(command, fault, false);
            if (may_replace) {
                try_calls(command, fault, true);
            }
        }
        clear(command);
    }
    EXPECT_GT(injected_, 50);
}

TEST_F(CrashPoints, a_folder_of_dances_changes_as_a_whole) {
    Command command = commands()[5];
    ASSERT_EQ(command.words[1], "figure");
    ASSERT_EQ(command.output, path("x"));
    std::vector<std::string> other = command.words;
    *std::find(other.begin(), other.end(), "4") = "3";  // states
    ASSERT_EQ(run(other).exit_code, 0);
    ASSERT_TRUE(write_file(path("x/d/notes.txt"), "of a person"));
    fs::copy(path("x"), path("saved"), fs::copy_options::recursive);
    const Contents old = contents_of(path("x/d"));
    ASSERT_EQ(run(command.words).exit_code, 0);
    const Contents changed = contents_of(path("x/d"));
    ASSERT_NE(changed, old);
    ASSERT_EQ(changed.size(), old.size());
    const std::vector<Fault> faults = {{"link", "signal=KILL"},
                                       {"linkat", "signal=KILL", 2},
                                       {"rename", "signal=KILL"},
                                       {"renameat2", "signal=KILL"},
                                       {"unlinkat", "signal=KILL", 2},
                                       {"fsync", "signal=KILL"}};
    for (const Fault& fault : faults) {
        const int most_calls = is_whole("RAKS_CRASH_POINTS") ? 1000 : fault.usual_calls;
        for (int when = 1; when <= most_calls; ++when) {
            SCOPED_TRACE(fault.call + " " + std::to_string(when));
            fs::remove_all(path("x"));
            fs::copy(path("saved"), path("x"), fs::copy_options::recursive);
            ProcessResult result;
            if (!run_with(command, fault, when, result)) {
                break;
            }
            ++injected_;
            const Contents now = contents_of(path("x/d"));
            EXPECT_TRUE(now == old || now == changed);
            ASSERT_EQ(run(command.words).exit_code, 0);
            EXPECT_EQ(contents_of(path("x/d")), changed);
            EXPECT_EQ(contents_of(path("x")).size(), changed.size()) << "nothing else is left";
        }
    }
    EXPECT_GE(injected_, 8);
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
