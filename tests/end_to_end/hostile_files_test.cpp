// Files that mean harm, or that a slip of the finger made, through the program: one line each,
// soon, and nothing else.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class HostileFiles : public ProgramTest {
 protected:
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((folder_ / name).parent_path());
        ASSERT_TRUE(write_file(folder_ / name, bytes));
    }
    /// A written dance with this head and these beats.
    static std::string dance(const std::string& name, int beats) {
        return "format = \"raks-choreography\"\nversion = 1\ndance = \"" + name +
               "\"\ntempo = [40, 60, 90]\n[[figure]]\nname = \"f\"\nbeats = " +
               std::to_string(beats) + "\nsteps = [ { foot = \"l\", at = 0, weight = -1 } ]\n";
    }
};

TEST_F(HostileFiles, a_slip_in_toml_is_a_line_and_column) {
    std::string dotted;
    for (int i = 0; i < 200'000; ++i) {
        dotted += "a.";
    }
    for (const std::string& text : {std::string("a=[}"), dotted + "a = 1", std::string("\n[\n")}) {
        write("x.toml", text);
        expect_one_line({"stick", path("x.toml"), "-o", path("x.png")}, 1, ", column ");
        expect_one_line({"train", "figure", path("x.toml"), "-o", path("out/")}, 1, ", column ");
        write("config/raks/config.toml", text);
        expect_one_line({"config", "show"}, 1, ", column ");
        fs::remove_all(folder_ / "config");
    }
    EXPECT_EQ(files(), std::vector<std::string>{"x.toml"});
}

TEST_F(HostileFiles, no_name_leads_out_of_its_folder) {
    for (const char* const name : {"../../evil", "/tmp/raks-evil", "..", "a/b", "\\u001b[2J"}) {
        write("x.toml", dance(name, 4));
        expect_one_line(
            {"train", "figure", path("x.toml"), "-o", path("out/")}, 1, "cannot name a dance");
        expect_one_line({"stick", path("x.toml"), "-o", path("x.png")}, 1, "line 3: dance: ");
    }
    EXPECT_EQ(files(), std::vector<std::string>{"x.toml"});
}

TEST_F(HostileFiles, training_refuses_a_name_that_leads_out_before_it_begins) {
    write("clip.bvh", "HIERARCHY\n");
    write("labels.tsv", "take\trole\tstart\tend\tfigure\tbeats\n");
    const std::vector<std::string> train = {
        "train", "figure", path("clip.bvh"), "--labels", path("labels.tsv"), "-o", path("out/")};
    for (const char* const option : {"--figure", "--dance"}) {
        auto command = train;
        command.insert(command.end(), {option, "../x"});
        expect_one_line(command, 1, "\"../x\" cannot ");
    }
    EXPECT_EQ(files(), (std::vector<std::string>{"clip.bvh", "labels.tsv"}));
}

TEST_F(HostileFiles, a_written_dance_says_which_number_is_too_much_work) {
    write("x.toml", dance("mine", 64));
    expect_one_line(
        {"stick", path("x.toml"), "-o", path("x.png")},
        1,
        "line 6: figure \"f\": beats is 64, 96 s at 40 BPM, the slowest tempo; a figure "
        "has at most 60 s");
}

TEST_F(HostileFiles, a_name_of_a_file_reaches_no_terminal) {
    write("x.toml", dance("mine", 4));
    const ProcessResult drawn =
        run({"stick", path("x.toml"), "--figure", "f", "-o", path("a\x1b[2J\nb.png")});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(drawn.out, path("a?[2J?b.png") + ": front and side of f, eighths of a beat\n");
    write_clicks("c\x1b[2J\nd.wav");
    const ProcessResult heard = run({"analyze", path("c\x1b[2J\nd.wav")});
    EXPECT_EQ(heard.exit_code, 0) << heard.err;
    EXPECT_EQ(heard.out.find('\x1b'), std::string::npos);
    EXPECT_TRUE(heard.out.starts_with(path("c?[2J?d.wav") + ": ")) << heard.out;
}

// Memory that cannot be had, at any point of the start: lines of ours, and no crash.
TEST_F(HostileFiles, too_little_memory_is_said) {
    write_clicks("song.wav");
    for (const long megabytes : {60L, 150L, 200L, 250L, 400L}) {
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"analyze", path("song.wav")},
              std::vector<std::string>{"dance", path("song.wav"), "-o", path("x.bvh")},
              std::vector<std::string>{"sheet", "--dance", "waltz", "-o", path("x.png")}}) {
            SCOPED_TRACE(words.front() + " with " + std::to_string(megabytes) + " MB");
            ProcessPlan tight = plan(words);
            tight.address_space_limit = megabytes << 20U;
            const ProcessResult result = run_process(tight);
            // Mesa does not look whether it was given memory: its fault is said in a line, too.
            const bool is_mesa = words.front() == "sheet" && result.exit_code == 128 + SIGSEGV;
            EXPECT_TRUE(result.exit_code <= 1 || is_mesa) << result.exit_code << result.err;
            EXPECT_TRUE(result.exit_code == 0 || !result.err.empty());
            std::istringstream lines(result.err);
            for (std::string line; std::getline(lines, line);) {
                EXPECT_TRUE(line.starts_with("raks: ")) << line;
            }
        }
    }
}

}  // namespace
}  // namespace raks::test
