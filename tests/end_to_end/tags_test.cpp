// What a file says of itself, as people see it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

class ToldByTags : public ProgramTest {
 protected:
    /// A rhythm that is not recognised in its first seconds, with tags.
    [[nodiscard]] std::string tagged(const std::string& name, const std::string& options) const {
        write_music("in.wav",
                    {.style = audio::Style::maqsum, .tempo = {{0.0, 110.0}}, .seconds = 3.0});
        const std::string command = "ffmpeg -nostdin -loglevel error -y -i '" + path("in.wav") +
                                    "' " + options + " '" + path(name) + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(concurrency-mt-unsafe)
        return path(name);
    }
    [[nodiscard]] nlohmann::json document(const std::vector<std::string>& arguments) const {
        const ProcessResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out);
    }
    void write_own_table(const std::string& rows) const {
        std::filesystem::create_directories(folder_ / "config" / "raks");
        ASSERT_TRUE(write_file(folder_ / "config" / "raks" / "genres.toml",
                               "format = \"raks-genres\"\nversion = 1\n" + rows));
    }
};

TEST_F(ToldByTags, are_told_by_analyze_and_can_be_ignored) {
    const std::string file = tagged("a.mp3", "-metadata genre='Bellydance; Arabic'");
    const auto told = document({"analyze", file, "--json"});
    EXPECT_EQ(told["tags"]["words"], (nlohmann::json{"bellydance", "arabic"}));
    EXPECT_EQ(told["tags"]["dance"], "belly");
    EXPECT_EQ(told["genre"][0]["label"], "belly");
    EXPECT_EQ(told["genre"][0]["by_tags"], true);
    const auto heard = document({"analyze", file, "--json", "--ignore-tags"});
    EXPECT_FALSE(heard.contains("tags"));
    EXPECT_EQ(heard["genre"][0]["label"], "unknown");
    EXPECT_FALSE(heard["genre"][0].contains("by_tags"));
}

TEST_F(ToldByTags, are_named_where_they_decide) {
    const std::string file =
        tagged("a.flac", "-metadata genre=Salsa -metadata title=$(printf 'a\\033[2Jb')");
    const ProcessResult text = run({"analyze", file});
    EXPECT_NE(text.out.find("dance  salsa, as the file says\n"), std::string::npos) << text.out;
    const ProcessResult play = run({"play", file, "--headless", "--no-sound", "--as-live"});
    EXPECT_EQ(play.exit_code, 0);
    EXPECT_NE(play.err.find("salsa, as the file says\n"), std::string::npos) << play.err;
    EXPECT_EQ(play.err.find('\033'), std::string::npos);
    const ProcessResult deaf =
        run({"play", file, "--headless", "--no-sound", "--as-live", "--ignore-tags"});
    EXPECT_EQ(deaf.err.find("as the file says"), std::string::npos) << deaf.err;
}

TEST_F(ToldByTags, mean_what_a_person_says_that_they_mean) {
    const std::string file = tagged("a.ogg", "-c:a libvorbis -metadata genre=Hafla");
    EXPECT_FALSE(document({"analyze", file, "--json"}).contains("tags"));
    write_own_table("[genre]\n\"hafla\" = \"belly\"\n");
    EXPECT_EQ(document({"analyze", file, "--json"})["tags"]["dance"], "belly");
}

TEST_F(ToldByTags, a_bad_table_is_one_line_with_its_place) {
    const std::string file = tagged("a.wav", "");
    write_own_table("[genre]\nhafla = \"bely\"\n");
    expect_one_line(
        {"analyze", file}, 1, "genres.toml: line 4: \"hafla\": dance \"bely\" is unknown");
    EXPECT_EQ(run({"analyze", file, "--ignore-tags"}).exit_code, 0);
    write_own_table("[genre]\n\"a b\" = \"belly\"\n\"A-B\" = \"salsa\"\n");
    expect_one_line(
        {"dance", file, "-o", path("x.bvh")}, 1, "genres.toml: line 5: \"A-B\": is the same");
}

class ToldByPerson : public ToldByTags {
 protected:
    void write_corrections(const std::string& text) const {
        std::filesystem::create_directories(folder_ / "state" / "raks");
        ASSERT_TRUE(write_file(folder_ / "state" / "raks" / "dances.tsv", text));
    }
    [[nodiscard]] std::string row(const std::string& dance, const std::string& song) const {
        const std::filesystem::path folder = std::filesystem::canonical(folder_.path());
        return "dance\tartist\tfolder\tsong\n" + dance + "\tCelia\t" + folder.string() + "\t" +
               (folder / song).string() + "\n";
    }
};

TEST_F(ToldByPerson, a_song_is_danced_as_they_said_and_measured_as_it_is) {
    const std::string file = tagged("a.flac", "-metadata genre=Salsa -metadata artist=Celia");
    const std::string before = run({"analyze", file, "--json"}).out;
    for (const char* const song : {"a.flac", "another of the album.flac"}) {
        SCOPED_TRACE(song);
        write_corrections(row("belly", song));
        for (const char* const tags : {"--ignore-tags", "--no-ignore-tags"}) {
            const ProcessResult play =
                run({"play", file, "--headless", "--no-sound", "--as-live", tags});
            EXPECT_EQ(play.exit_code, 0);
            EXPECT_NE(play.err.find("belly, as you said\n"), std::string::npos) << play.err;
            EXPECT_EQ(play.err.find("as the file says"), std::string::npos) << play.err;
        }
        const ProcessResult dance = run({"-v", "dance", file, "-o", path("x.bvh")});
        EXPECT_EQ(dance.exit_code, 0);
        EXPECT_NE(dance.err.find("you said belly\n"), std::string::npos) << dance.err;
        EXPECT_EQ(run({"analyze", file, "--json"}).out, before) << "analyze reads no state";
    }
}

TEST_F(ToldByPerson, a_bad_file_is_one_line_with_its_place_and_the_music_plays) {
    const std::string file = tagged("a.flac", "-metadata genre=Salsa");
    write_corrections("dance\tartist\tfolder\tsong\nbelly\tCelia\n");
    const ProcessResult play = run({"play", file, "--headless", "--no-sound", "--as-live"});
    EXPECT_EQ(play.exit_code, 0);
    EXPECT_NE(
        play.err.find("dances.tsv: line 2: 2 columns, there must be 4; no dance that you said "
                      "is used\n"),
        std::string::npos)
        << play.err;
    EXPECT_NE(play.err.find("salsa, as the file says\n"), std::string::npos) << play.err;
}

}  // namespace
}  // namespace raks::test
