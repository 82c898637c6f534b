// From a dance that somebody wrote or captured to the dancer who dances it, by the lines of README.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "tests/end_to_end/manual.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/dances.hpp"
#include "tests/training/discovery/stepping_dance.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class TeachDance : public ProgramTest {
 protected:
    void SetUp() override {
        audio::MusicPlan plan;
        plan.style = audio::Style::drums;
        plan.tempo = {{0.0, 120.0}};
        plan.seconds = 8.0;
        write_music("song.wav", plan);
        fs::rename(folder_ / "song.wav", folder_ / "song.mp3");  // told by what it holds
        write_dance(folder_ / "my.toml", "tango");
        draw_small_pictures();
    }

    /// Runs a command in the test's folder.
    [[nodiscard]] ProcessResult run_here(std::vector<std::string> arguments) const {
        ProcessPlan here = plan(std::move(arguments));
        here.folder = folder_.path().string();
        return run_process(here);
    }

    void expect_done(const std::vector<std::string>& arguments) const {
        const ProcessResult result = run_here(arguments);
        EXPECT_EQ(result.exit_code, 0) << fmt::format("{}", fmt::join(arguments, " ")) << "\n"
                                       << result.err;
    }

    /// What `raks dances` says of a dance; null where it has none of that name.
    [[nodiscard]] nlohmann::json found(const std::string& dance) const {
        const ProcessResult result = run_here({"dances", "--json"});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        const auto document = nlohmann::json::parse(result.out);
        for (const auto& one : document["dances"]) {
            if (one["name"] == dance) {
                return one;
            }
        }
        return nullptr;
    }
};

/// The commands of README's section.
std::vector<std::vector<std::string>> commands_of_readme() {
    std::vector<std::vector<std::string>> commands;
    for (const ManualCommand& command : commands_of("README.md")) {
        if (command.is_run && command.section == "Teach it a dance") {
            commands.push_back(without_window(command.words));
        }
    }
    return commands;
}

TEST_F(TeachDance, the_lines_of_readme_end_with_the_dance_danced) {
    write_clips(folder_.path());
    const auto commands = commands_of_readme();
    ASSERT_GE(commands.size(), 6U);
    for (const auto& command : commands) {
        expect_done(command);
    }
    EXPECT_EQ(found("tango")["figures"], (nlohmann::json{"box", "natural_turn", "balance"}));
    EXPECT_EQ(found("tango")["origin"], "yours");
    EXPECT_EQ(found("polka")["figures"], nlohmann::json{"basic"});
    EXPECT_NEAR(found("polka")["likely_tempo"].get<double>(), 180.0, 1.0);
    EXPECT_TRUE(fs::exists(folder_ / "my_box.png"));
    EXPECT_TRUE(fs::exists(folder_ / "polka.png"));
}

TEST_F(TeachDance, what_is_learnt_is_danced_by_name_by_folder_and_by_its_text) {
    write_dance_of_one_figure(folder_ / "my.toml", "tango");
    const ProcessResult learnt = run_here({"train", "figure", "my.toml"});
    ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
    const std::string folder = (folder_ / "share/raks/dances/tango").string();
    EXPECT_NE(learnt.err.find("raks: tango lies in " + folder +
                              "; raks play SONG --dance tango dances it"),
              std::string::npos)
        << learnt.err;
    expect_done({"dance", "song.mp3", "--dance", "tango", "-o", "name.bvh"});
    expect_done({"dance", "song.mp3", "--dance", folder, "-o", "folder.bvh"});
    expect_done({"dance", "song.mp3", "--dance", "my.toml", "-o", "text.bvh"});
    const auto by_name = read_file(folder_ / "name.bvh");
    ASSERT_TRUE(by_name);
    EXPECT_EQ(*by_name, *read_file(folder_ / "folder.bvh"));
    EXPECT_EQ(*by_name, *read_file(folder_ / "text.bvh"));
    expect_done({"dance", "song.mp3", "--dance", "waltz", "-o", "waltz.bvh"});
    EXPECT_NE(*by_name, *read_file(folder_ / "waltz.bvh")) << "its own grammar, not the waltz's";
}

/// A clip of six repeats of one figure at 166 BPM, the third with raised arms.
void write_unlabelled_clip(const fs::path& file) {
    motion::test::SteppingDance dance;
    dance.raised = {2};
    const motion::TrainingClip clip = motion::test::stepping_clip(dance);
    ASSERT_TRUE(motion::write_bvh(file, motion::mannequin_skeleton(), clip.poses, 60.0));
}

TEST_F(TeachDance, a_clip_that_nobody_labelled_is_learnt_and_danced) {
    write_unlabelled_clip(folder_ / "mine.bvh");
    const ProcessResult learnt = run_here({"train", "figure", "mine.bvh"});
    ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
    EXPECT_NE(learnt.out.find("mine: 5 of 6 repeats of 8 beats"), std::string::npos) << learnt.out;
    EXPECT_EQ(found("mine")["figures"], nlohmann::json{"basic"});
    EXPECT_NEAR(found("mine")["likely_tempo"].get<double>(), 60.0 / 0.36, 5.0);
    expect_done({"dance", "song.mp3", "--dance", "mine", "-o", "mine_danced.bvh"});
    expect_done({"train", "figure", "mine.bvh", "--once", "-o", "once"});
    expect_done({"dance", "song.mp3", "--dance", "once", "-o", "once_danced.bvh"});
}

TEST_F(TeachDance, repeats_are_proposed_as_labels_that_can_be_edited_and_learnt) {
    write_unlabelled_clip(folder_ / "mine.bvh");
    const ProcessResult proposed =
        run_here({"train", "figure", "mine.bvh", "--propose", "repeats.tsv"});
    ASSERT_EQ(proposed.exit_code, 0) << proposed.err;
    EXPECT_TRUE(fs::exists(folder_ / "repeats.html"));
    EXPECT_EQ(found("mine"), nullptr) << "nothing is learnt";
    auto table = read_file(folder_ / "repeats.tsv");
    ASSERT_TRUE(table);
    table->erase(table->rfind("mine\tlead"));  // the last repeat
    ASSERT_TRUE(write_file(folder_ / "repeats.tsv", *table));
    const ProcessResult learnt =
        run_here({"train", "figure", "mine.bvh", "--labels", "repeats.tsv", "-o", "mine"});
    ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
    EXPECT_NE(learnt.out.find("4 of 5 repeats"), std::string::npos) << learnt.out;
}

TEST_F(TeachDance, clips_that_tell_nothing_are_refused_in_one_line) {
    motion::test::SteppingDance dance;
    motion::TrainingClip still = motion::test::stepping_clip(dance);
    std::fill(still.poses.begin(), still.poses.end(), still.poses.front());
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "still.bvh", motion::mannequin_skeleton(), still.poses, 60.0));
    const ProcessResult result = run_here({"train", "figure", "still.bvh", "--scale", "1"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "raks: still.bvh: nothing moves in it\n");
    dance.repeats = 1;
    const motion::TrainingClip once = motion::test::stepping_clip(dance);
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "one go.bvh", motion::mannequin_skeleton(), once.poses, 60.0));
    const ProcessResult none =
        run_here({"train", "figure", "one go.bvh", "--scale", "1", "-o", "once"});
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_EQ(none.err,
              "raks: one go.bvh: nothing in it repeats; --once learns it as a single phrase, raks "
              "train take beat by beat\n");
}

TEST_F(TeachDance, too_few_repeats_are_no_figure) {
    motion::test::SteppingDance dance;
    dance.raised = {1, 2};
    dance.repeats = 4;
    const motion::TrainingClip clip = motion::test::stepping_clip(dance);
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "few.bvh", motion::mannequin_skeleton(), clip.poses, 60.0));
    const ProcessResult few = run_here({"train", "figure", "few.bvh", "--scale", "1"});
    EXPECT_EQ(few.exit_code, 1) << few.out;
    EXPECT_NE(few.err.find("repeats are alike, and a figure needs 3: nothing is learnt; --once"),
              std::string::npos)
        << few.err;
    EXPECT_NE(few.err.find("raks train take"), std::string::npos) << few.err;
    EXPECT_EQ(found("few"), nullptr);
}

TEST_F(TeachDance, a_clip_danced_once_has_the_name_of_its_file_made_plain) {
    motion::test::SteppingDance dance;
    dance.repeats = 2;
    const motion::TrainingClip clip = motion::test::stepping_clip(dance);
    fs::create_directories(folder_ / "my clips");
    for (const char* const name : {"my clips/One Go (1).bvh", "my clips/two.bvh"}) {
        ASSERT_TRUE(
            motion::write_bvh(folder_ / name, motion::mannequin_skeleton(), clip.poses, 60.0));
    }
    const std::string one = "my clips/One Go (1).bvh";
    expect_done({"train", "figure", one, "--scale", "1", "--once", "--bpm", "166.67"});
    EXPECT_EQ(found("One_Go_1")["figures"], nlohmann::json{"One_Go_1"});
    expect_done({"train", "figure", one, "--scale", "1", "--once", "-o", "my model.json"});
    const auto model = read_file(folder_ / "my model.json");
    ASSERT_TRUE(model);
    EXPECT_EQ(nlohmann::json::parse(*model)["dance"], "my_model");
    expect_done({"train", "figure", one, "--scale", "1", "--once", "--dance", "told"});
    EXPECT_EQ(found("told")["figures"], nlohmann::json{"One_Go_1"});
    // All clips of a folder are one dance; what is none is left out.
    ASSERT_TRUE(write_file(folder_ / "my clips/broken.bvh", "HIERARCHY"));
    const ProcessResult folder =
        run_here({"train", "figure", "my clips", "--scale", "1", "--once", "--travel", "none"});
    EXPECT_EQ(folder.exit_code, 3) << folder.err;
    EXPECT_NE(folder.err.find("it is left out"), std::string::npos) << folder.err;
    EXPECT_EQ(found("my_clips")["figures"], (nlohmann::json{"One_Go_1", "two"}));
    expect_done({"dance", "song.mp3", "--dance", "my_clips", "-o", "both.bvh"});
}

TEST_F(TeachDance, a_long_clip_is_learnt_whole_as_figures_in_its_order) {
    motion::test::SteppingDance dance;
    dance.repeats = 9;
    const motion::TrainingClip clip = motion::test::stepping_clip(dance);
    ASSERT_TRUE(
        motion::write_bvh(folder_ / "long.bvh", motion::mannequin_skeleton(), clip.poses, 60.0));
    const ProcessResult learnt =
        run_here({"train", "figure", "long.bvh", "--scale", "1", "--once", "--beats", "75"});
    ASSERT_EQ(learnt.exit_code, 0) << learnt.err;
    EXPECT_NE(learnt.err.find("its 75 beats become 2 figures, long_1 to long_2"), std::string::npos)
        << learnt.err;
    EXPECT_EQ(found("long")["figures"], (nlohmann::json{"long_1", "long_2"}));
    expect_done({"dance", "song.mp3", "--dance", "long", "-o", "long_danced.bvh"});
    const ProcessResult file = run_here(
        {"train", "figure", "long.bvh", "--scale", "1", "--once", "--beats", "75", "-o", "x.json"});
    EXPECT_EQ(file.exit_code, 1);
    EXPECT_NE(file.err.find("these are 2: give -o a folder or a name"), std::string::npos)
        << file.err;
    const ProcessResult repeats = run_here({"train", "figure", "long.bvh", "--beats", "75"});
    EXPECT_EQ(repeats.exit_code, 2);
}

TEST_F(TeachDance, its_grammar_can_be_edited_and_is_kept) {
    expect_done({"train", "figure", "my.toml", "--figure", "box"});
    const fs::path grammar = folder_ / "share/raks/dances/tango/tango.toml";
    auto text = read_file(grammar);
    ASSERT_TRUE(text);
    EXPECT_NE(text->find("name = \"box\"\nseen = 1\n"), std::string::npos) << *text;
    ASSERT_TRUE(write_file(grammar, *text + "energy = 0.9  # mine\n"));
    expect_done({"train", "figure", "my.toml"});
    const auto after = read_file(grammar);
    ASSERT_TRUE(after);
    EXPECT_NE(after->find("energy = 0.9  # mine\n"), std::string::npos) << *after;
    EXPECT_EQ(found("tango")["figures"], (nlohmann::json{"box", "natural_turn", "balance"}));
}

TEST_F(TeachDance, a_figure_joins_a_dance_that_there_is) {
    expect_done(
        {"train", "figure", "my.toml", "--figure", "balance", "--extends", "rock", "-o", "more"});
    const auto rock = found("rock");
    EXPECT_EQ(rock["origin"], "shipped");
    EXPECT_EQ(rock["figures"].back(), "balance");
    EXPECT_EQ(rock["extensions"].size(), 1U);
    expect_done({"sheet", "--dance", "rock", "--figure", "balance", "-o", "x.png"});
}

TEST_F(TeachDance, a_dance_of_the_users_shadows_one_and_that_is_said) {
    write_dance(folder_ / "own.toml", "waltz");
    expect_done({"train", "figure", "own.toml", "--figure", "box"});
    const ProcessResult result = run_here({"dance", "song.mp3", "--dance", "waltz", "-o", "x.bvh"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("raks: waltz is danced from " +
                              (folder_ / "share/raks/dances/waltz").string() + " and not from "),
              std::string::npos)
        << result.err;
    EXPECT_EQ(found("waltz")["figures"], nlohmann::json{"box"});
}

TEST_F(TeachDance, names_that_no_file_can_have_are_refused) {
    for (const std::string name : {"my tango", "tängo", "auto", "-x"}) {
        const ProcessResult result = run_here({"train", "figure", "my.toml", "-o=" + name});
        EXPECT_EQ(result.exit_code, 1) << name << "\n" << result.err;
        EXPECT_TRUE(is_one_error_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("cannot name a dance"), std::string::npos) << result.err;
    }
    expect_one_line(
        {"play", path("song.mp3"), "--dance", "tango"}, 2, "dance \"tango\" is unknown");
    expect_one_line({"dance", path("song.mp3"), "--dance", path("none.toml"), "-o", path("x.bvh")},
                    1,
                    "none.toml");
    expect_one_line({"dance", path("song.mp3"), "--dance", path(""), "-o", path("x.bvh")},
                    1,
                    "holds no dances.toml");
}

TEST_F(TeachDance, a_broken_dance_is_named_and_the_show_goes_on) {
    const fs::path dances = folder_ / "share/raks/dances";
    expect_done({"train", "figure", "my.toml", "--figure", "box"});
    ASSERT_TRUE(write_file(dances / "tango/tango_box_lead.json", "{"));
    fs::create_directories(dances / "empty");
    fs::create_directories(dances / "odd");
    ASSERT_TRUE(write_file(dances / "odd/dances.toml", "format = \"raks-dances\"\nversion = 9\n"));
    fs::create_directories(dances / "half");
    ASSERT_TRUE(write_file(dances / "half/dances.toml",
                           "format = \"raks-dances\"\nversion = 1\n[[dance]]\nname = \"half\"\n"));
    fs::create_directories(dances / "style");
    ASSERT_TRUE(write_file(dances / "style/dances.toml",
                           "format = \"raks-dances\"\nversion = 1\n[[dance]]\nname = \"style\"\n"
                           "style = \"drum\"\n"));

    const ProcessResult result = run_here({"dance", "song.mp3", "-o", "x.bvh"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    for (const std::string line :
         {"empty: holds no dances.toml; `raks train figure` writes one",
          "odd/dances.toml: version must be a number up to 1; is Raks older than the file?",
          "half: half.toml is not there, so that half cannot be danced",
          "style/dances.toml: line 5: style \"drum\" is unknown; did you mean \"drums\"?",
          "raks: tango is left out: "}) {
        EXPECT_NE(result.err.find(line), std::string::npos) << line << "\n" << result.err;
    }
    EXPECT_NE(found("tango")["fault"].get<std::string>().find("tango_box_lead.json"),
              std::string::npos);
    EXPECT_EQ(found("waltz")["fault"], "");
}

TEST_F(TeachDance, a_thousand_dances_are_cut_and_that_is_said) {
    const fs::path dances = folder_ / "share/raks/dances";
    for (int i = 0; i < 1000; ++i) {
        const std::string name = fmt::format("dance{:04}", i);
        fs::create_directories(dances / name);
        // Not by write_file, which waits for the disk.
        std::ofstream(dances / name / "dances.toml") << fmt::format(
            "format = \"raks-dances\"\nversion = 1\n[[dance]]\nname = \"{}\"\n", name);
        std::ofstream(dances / name / (name + ".toml")) << fmt::format(
            "format = \"raks-dance\"\nversion = 1\ndance = \"{}\"\n[[figure]]\nname = \"x\"\n",
            name);
    }
    const ProcessResult result = run_here({"dance", "song.mp3", "--dance", "waltz", "-o", "x.bvh"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::size_t shipped = shipped_dances()->size();
    EXPECT_EQ(result.err,
              fmt::format("raks: there are {} dances; dance{:04} and those after it are left out\n",
                          shipped + 1000,
                          kMostDances - shipped));
}

}  // namespace
}  // namespace raks::test
