// raks eval genre on written music, one file of which says its dance.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "base/file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

namespace fs = std::filesystem;

class EvalGenre : public ProgramTest {
 protected:
    void SetUp() override {
        ProgramTest::SetUp();
        fs::create_directories(path("music/house"));
        fs::create_directories(path("music/other"));
        write_music(
            "music/house/a.wav",
            {.style = audio::Style::four_on_the_floor, .tempo = {{0.0, 124.0}}, .seconds = 12.0});
        write_music("music/other/b.wav",
                    {.style = audio::Style::drums, .tempo = {{0.0, 90.0}}, .seconds = 12.0});
        const std::string command = "ffmpeg -nostdin -loglevel error -i '" +
                                    path("music/house/a.wav") + "' -metadata genre=House '" +
                                    path("music/house/tagged.flac") + "'";
        ASSERT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(concurrency-mt-unsafe)
    }
};

TEST_F(EvalGenre, says_what_would_be_shown_by_each_part_alone_and_by_all) {
    const ProcessResult result = run({"eval", "genre", path("music"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    std::map<std::string, nlohmann::json> by;
    for (const auto& row : json["shown_by"]) {
        by[row["evidence"]] = row;
    }
    EXPECT_EQ(by["tags"]["files"], 1) << "the others say nothing";
    EXPECT_EQ(by["tags"]["right_at_end"], 1);
    for (const char* const evidence : {"own parts", "heard", "all"}) {
        EXPECT_EQ(by[evidence]["files"], 3) << evidence;
    }
    // What is heard is the decision that the rows before tell of.
    EXPECT_EQ(by["heard"]["right_at_end"], json["right_at_end"]);
    EXPECT_EQ(by["heard"]["wrong_share"], json["wrong_share"]);
    EXPECT_EQ(by["heard"]["switches_a_minute"], json["switches_a_minute"]);
    for (const auto& file : json["shown"]) {
        EXPECT_EQ(file["at_end_by"].contains("tags"), file["file"] == "house/tagged.flac");
        EXPECT_EQ(file["at_end"], file["at_end_by"]["heard"]);
    }
}

TEST_F(EvalGenre, says_by_confidence_how_often_the_shown_dance_is_right) {
    const ProcessResult result = run({"eval", "genre", path("music"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    // Ten decisions a second from 5 s on of three files of 12 s, and in one file by tags.
    constexpr int kMost = 3 * 71;
    for (const auto& [voice, bins] : json["reliability"].items()) {
        int claims = 0;
        for (const auto& bin : bins) {
            claims += bin["claims"].get<int>();
            EXPECT_LE(bin["right"], bin["claims"]) << voice;
        }
        EXPECT_LE(claims, kMost) << voice;
    }
    // The tag names the right dance from the start on.
    ASSERT_TRUE(json["reliability"].contains("tags"));
    int told = 0;
    for (const auto& bin : json["reliability"]["tags"]) {
        told += bin["claims"].get<int>();
        EXPECT_EQ(bin["right"], bin["claims"]);
    }
    EXPECT_NEAR(told, kMost / 3.0, 3.0);
    const ProcessResult text = run({"eval", "genre", path("music")});
    EXPECT_NE(text.out.find("| confidence | "), std::string::npos) << text.out;
}

TEST_F(EvalGenre, without_the_tagger_it_has_no_row) {
    const ProcessResult result = run({"eval", "genre", path("music"), "--tagger", "off"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("\nown parts "), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("\ntagger "), std::string::npos) << result.out;
}

TEST_F(EvalGenre, draws_each_file_over_time) {
    const ProcessResult result =
        run({"eval", "genre", path("music"), "--plot", path("made/plots")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto plain = read_file(path("made/plots/house_a.svg"));
    const auto tagged = read_file(path("made/plots/house_tagged.svg"));
    ASSERT_TRUE(plain && tagged);
    EXPECT_TRUE(is_there(path("made/plots/other_b.svg")));
    EXPECT_NE(plain->find(">house_a: house</text>"), std::string::npos);
    EXPECT_EQ(plain->find("<g id=\"tags\">"), std::string::npos);
    EXPECT_NE(tagged->find("<g id=\"tags\">"), std::string::npos);
    EXPECT_NE(tagged->find("<g id=\"all\">"), std::string::npos);
}

TEST_F(EvalGenre, a_folder_that_cannot_be_made_is_said_before_anything_is_heard) {
    write_clicks("file");
    expect_one_line({"eval", "genre", path("music"), "--plot", path("file/plots")}, 1, "file");
}

}  // namespace
}  // namespace raks::test
