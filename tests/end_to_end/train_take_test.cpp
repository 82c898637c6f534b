// `raks train take`: whole takes with labelled beats, to the dancer who dances them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class TrainTake : public ProgramTest {
 protected:
    void SetUp() override {
        // Twenty seconds: two of them, ten times.
        std::string text = *read_text_file(
            fs::path(RAKS_SOURCE_DIR) / "tests/data/bvh/dance/own_dance.bvh", 1'000'000);
        const std::string frames = text.substr(text.find('\n', text.find("Frame Time:")) + 1);
        for (int i = 1; i < 10; ++i) {
            text += frames;
        }
        text.replace(text.find("Frames: 60"), 10, "Frames: 600");
        ASSERT_TRUE(write_file(folder_ / "mine.bvh", text));
        write_table(1);
    }
    /// A beat each half second; `used` of all.
    void write_table(int used) const {
        std::string table = "take\ttime\thalf\tused\n";
        for (int beat = 0; beat < 39; ++beat) {
            table += fmt::format("mine\t{}\t{}\t{}\n", 0.25 + 0.5 * beat, 1 + beat % 2, used);
        }
        ASSERT_TRUE(write_file(folder_ / "beats.tsv", table));
    }
    [[nodiscard]] ProcessResult train() const {
        return run({"train",
                    "take",
                    path("mine.bvh"),
                    "--counts",
                    path("beats.tsv"),
                    "--licence",
                    "by nobody",
                    "-o",
                    "mine"});
    }
};

TEST_F(TrainTake, a_take_is_danced_by_its_name) {
    const ProcessResult trained = train();
    ASSERT_EQ(trained.exit_code, 0) << trained.err;
    EXPECT_NE(trained.err.find("mine: 37 of 39 beats are danced"), std::string::npos)
        << trained.err;
    const ProcessResult listed = run({"dances"});
    EXPECT_NE(listed.out.find("beats of people's takes: mine_1"), std::string::npos) << listed.out;
    EXPECT_NE(listed.out.find("the takes are not under MIT or Apache-2.0, as Raks is: by nobody"),
              std::string::npos)
        << listed.out;
    write_clicks("song.wav", 8.0);
    const ProcessResult danced =
        run({"dance", path("song.wav"), "--dance", "mine", "-o", path("x.bvh")});
    EXPECT_EQ(danced.exit_code, 0) << danced.err;
    EXPECT_TRUE(fs::exists(path("x.bvh")));
}

TEST_F(TrainTake, what_raks_danced_is_learnt_again_and_a_repeat_of_it_is_found) {
    ASSERT_EQ(train().exit_code, 0);
    write_clicks("song.wav", 12.0);
    ASSERT_EQ(
        run({"dance", path("song.wav"), "--dance", "mine", "-o", path("again.bvh")}).exit_code, 0);
    // The same dance twice, 24 beats each.
    std::string text = *read_text_file(path("again.bvh"), 100'000'000);
    const std::size_t count = text.find("Frames: ") + 8;
    const int frames = std::stoi(text.substr(count));
    text += text.substr(text.find('\n', text.find("Frame Time:")) + 1);
    text.replace(count, std::to_string(frames).size(), std::to_string(2 * frames));
    ASSERT_TRUE(write_file(path("again.bvh"), text));
    std::string table = "take\ttime\thalf\tused\n";
    for (int beat = 0; beat < 46; ++beat) {
        table += fmt::format("again\t{}\t{}\t1\n", 0.5 + 0.5 * beat, 1 + beat % 2);
    }
    ASSERT_TRUE(write_file(folder_ / "again.tsv", table));
    const ProcessResult trained = run({"train",
                                       "take",
                                       path("again.bvh"),
                                       "--counts",
                                       path("again.tsv"),
                                       "--without",
                                       "mine",
                                       "-o",
                                       "again"});
    EXPECT_NE(trained.err.find("mine: cannot be left out, the table has no such take"),
              std::string::npos)
        << trained.err;
    const ProcessResult again =
        run({"train", "take", path("again.bvh"), "--counts", path("again.tsv"), "-o", "again"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    const std::size_t said = again.err.find(" cells are repeats of ");
    ASSERT_NE(said, std::string::npos) << again.err;
    const std::size_t number = again.err.rfind(' ', said - 1) + 1;
    EXPECT_GE(std::stoi(again.err.substr(number)), 20) << again.err;
    EXPECT_EQ(run({"dance", path("song.wav"), "--dance", "again", "-o", path("y.bvh")}).exit_code,
              0);
}

TEST_F(TrainTake, what_takes_do_not_have_is_refused_in_one_line) {
    ASSERT_EQ(train().exit_code, 0);
    write_clicks("song.wav", 2.0);
    const std::vector<std::string> dance = {
        "dance", path("song.wav"), "--dance", "mine", "-o", path("x.bvh")};
    auto couple = dance;
    couple.insert(couple.end(), {"--formation", "couple"});
    expect_one_line(couple, 1, "mine is danced alone");
    auto frames = dance;
    frames.insert(frames.end(), {"--generator", "frames"});
    expect_one_line(frames, 1, "mine is a dance of whole takes");
}

TEST_F(TrainTake, its_cells_are_drawn_and_reported) {
    ASSERT_EQ(train().exit_code, 0);
    const std::string cells = path("share/raks/dances/mine/mine.cells");
    const ProcessResult reported = run({"train", "report", cells, "-o", path("x.html")});
    ASSERT_EQ(reported.exit_code, 0) << reported.err;
    EXPECT_NE(reported.out.find(" cells of 1 take, "), std::string::npos) << reported.out;
    const auto page = read_text_file(folder_ / "x.html", 1'000'000);
    ASSERT_TRUE(page);
    EXPECT_NE(page->find("How mine hangs together"), std::string::npos);
    expect_one_line(
        {"train", "report", path("mine.bvh"), "-o", path("x.html")}, 1, "--labels is required");
    const ProcessResult drawn = run({"sheet", "--dance", "mine", "-o", path("x.png")});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_TRUE(fs::exists(path("x.png")));
    expect_one_line({"sheet", "--dance", "mine", "--figure", "mine_7", "-o", path("y.png")},
                    1,
                    "take \"mine_7\" is unknown; did you mean \"mine_1\"?");
}

TEST_F(TrainTake, a_grid_is_proposed_that_can_be_learnt) {
    const ProcessResult proposed =
        run({"train", "take", path("mine.bvh"), "--propose", path("beats.tsv")});
    ASSERT_EQ(proposed.exit_code, 0) << proposed.err;
    EXPECT_NE(proposed.out.find("mine: "), std::string::npos) << proposed.out;
    EXPECT_NE(proposed.err.find("motion alone is right in about half of the cases"),
              std::string::npos)
        << proposed.err;
    EXPECT_TRUE(fs::exists(path("beats.html")));
    const ProcessResult drawn =
        run({"stick", path("mine.bvh"), "--counts", path("beats.tsv"), "--strips", path("strips")});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_TRUE(fs::exists(path("strips/mine.png")) || fs::exists(path("strips/mine_1.png")));
    EXPECT_EQ(train().exit_code, 0);
}

TEST_F(TrainTake, a_grid_of_the_song_lies_on_its_beats) {
    write_clicks("song.wav", 20.0);
    const ProcessResult proposed = run({"train",
                                        "take",
                                        path("mine.bvh"),
                                        "--music",
                                        path("song.wav"),
                                        "--offset",
                                        "0.25",
                                        "--propose",
                                        path("beats.tsv")});
    ASSERT_EQ(proposed.exit_code, 0) << proposed.err;
    EXPECT_NE(read_file(folder_ / "beats.html").value_or("").find("begins at 0.25 s"),
              std::string::npos);
    const ProcessResult found = run({"train",
                                     "take",
                                     path("mine.bvh"),
                                     "--music",
                                     path("song.wav"),
                                     "--propose",
                                     path("beats.tsv")});
    ASSERT_EQ(found.exit_code, 0) << found.err;
    EXPECT_NE(found.err.find("by landings the clip begins"), std::string::npos) << found.err;
}

TEST_F(TrainTake, what_is_missing_to_learn_or_propose_is_said_in_one_line) {
    expect_one_line({"train", "take", path("mine.bvh")}, 2, "--propose X.tsv");
    expect_one_line(
        {"train", "take", path("mine.bvh"), "--propose", path("beats.html")}, 2, "call it X.tsv");
    expect_one_line({"train", "take", path("none.bvh"), "--propose", path("b.tsv")}, 1, "none.bvh");
    expect_one_line({"train",
                     "take",
                     path("mine.bvh"),
                     "--counts",
                     path("beats.tsv"),
                     "--propose",
                     path("b.tsv")},
                    2,
                    "--counts");
}

TEST_F(TrainTake, tables_that_make_no_dance_are_refused_in_one_line) {
    write_table(0);
    const ProcessResult unused = train();
    EXPECT_EQ(unused.exit_code, 1);
    EXPECT_NE(unused.err.find("no beat of the takes can be danced"), std::string::npos)
        << unused.err;
    ASSERT_TRUE(write_file(folder_ / "beats.tsv",
                           "take\ttime\thalf\tused\nother\t0.5\t1\t1\nother\t1\t2\t1\n"));
    EXPECT_NE(train().err.find("other: is not among the clips"), std::string::npos);
    ASSERT_TRUE(write_file(folder_ / "beats.tsv",
                           "take\ttime\thalf\tused\nmine\t2\t1\t1\nmine\t1\t2\t1\n"));
    EXPECT_NE(train().err.find("line 3: time is 1, must be after the beat before (2)"),
              std::string::npos);
}

}  // namespace
}  // namespace raks::test
