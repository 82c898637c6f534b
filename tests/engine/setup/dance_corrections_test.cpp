#include "engine/setup/dance_corrections.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kColumns = "dance\tartist\tfolder\tsong\n";

std::string fault_of_corrections(const std::string& text) {
    const auto corrections = DanceCorrections::parse(text, "dances.tsv");
    return corrections ? "" : corrections.error().message;
}

DanceCorrections two_songs() {
    DanceCorrections corrections;
    EXPECT_TRUE(corrections.set({"salsa", "Celia", "/music/son", "/music/son/1.mp3"}));
    EXPECT_TRUE(corrections.set({"hip hop", "", "/music", "/music/a \"b\" \xc3\xb6\xff.ogg"}));
    return corrections;
}

TEST(DanceCorrectionsFile, says_what_was_written) {
    const DanceCorrections corrections = two_songs();
    const auto read = DanceCorrections::parse(corrections.to_tsv(), "dances.tsv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->all(), corrections.all());
    EXPECT_EQ(read->of_song("/music/son/1.mp3"), "salsa");
    EXPECT_EQ(read->of_song("/music/son/../son/1.mp3"), "salsa");
    EXPECT_EQ(read->of_song("/music/son/2.mp3"), "");
}

TEST(DanceCorrections, of_the_same_song_the_later_replaces_the_earlier) {
    DanceCorrections corrections = two_songs();
    ASSERT_TRUE(corrections.set({"belly", "Celia", "/music/son", "/music/son/1.mp3"}));
    EXPECT_EQ(corrections.all().size(), 2U);
    EXPECT_EQ(corrections.of_song("/music/son/1.mp3"), "belly");
    EXPECT_EQ(corrections.all().back().dance, "belly") << "the newest";
}

TEST(DanceCorrectionsFile, of_very_many_rows_is_read_and_the_last_of_each_song_counts) {
    constexpr int kSongs = 40'000;
    std::string text = kColumns;
    for (const char* const dance : {"rock", "salsa"}) {
        for (int song = 0; song < kSongs; ++song) {
            text += std::string(dance) + "\tCelia\t/son\t/son/" + std::to_string(song) + "\n";
        }
    }
    const auto read = DanceCorrections::parse(text, "dances.tsv");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->all().size(), static_cast<std::size_t>(kSongs));
    EXPECT_EQ(read->all().front().song, "/son/0") << "in their order";
    EXPECT_EQ(read->of_song("/son/0"), "salsa");
    EXPECT_EQ(read->of_song("/son/39999"), "salsa");
}

TEST(DanceCorrections, of_an_album_are_those_of_one_artist_in_one_folder) {
    DanceCorrections corrections = two_songs();
    ASSERT_TRUE(corrections.set({"salsa", "Celia", "/music/son", "/music/son/2.mp3"}));
    ASSERT_TRUE(corrections.set({"rock", "Celia", "/music/son", "/music/son/3.mp3"}));
    using Dances = std::vector<std::pair<std::string, int>>;
    EXPECT_EQ(corrections.of_album("Celia", "/music/son/9.mp3"),
              (Dances{{"salsa", 2}, {"rock", 1}}));
    EXPECT_EQ(corrections.of_album("Tito", "/music/son/9.mp3"), Dances());
    EXPECT_EQ(corrections.of_album("Celia", "/music/other/9.mp3"), Dances());
    EXPECT_EQ(corrections.of_album("", "/music/9.mp3"), Dances()) << "nobody's songs are no album";
}

TEST(DanceCorrectionsFile, that_is_bad_is_told_with_its_line) {
    const std::string good = "salsa\tCelia\t/a\t/a/1.mp3\n";
    const struct {
        std::string text;
        std::string fault;
    } cases[] = {
        {"", ""},
        {kColumns, ""},
        {kColumns + good + "\n" + good, ""},
        {good,
         "dances.tsv: line 1: must name the columns dance, artist, folder and song; this is "
         "another "
         "kind of file"},
        {kColumns + good + "salsa\t/a\t/a/1.mp3\n",
         "dances.tsv: line 3: 3 columns, there must be 4"},
        {kColumns + std::string("salsa\tC\telia\t/a\t/a/1.mp3\n"),
         "dances.tsv: line 2: 5 columns, there must be 4"},
        {kColumns + std::string("salsa\tCelia\ta\t/a/1.mp3\n"),
         "dances.tsv: line 2: \"a\" is no absolute path"},
        {kColumns + std::string("salsa\tCelia\t/a\t\n"),
         "dances.tsv: line 2: \"\" is no absolute path"},
        {kColumns + std::string("salsa\tCe\x1b[2Jlia\t/a\t/a/1.mp3\n"),
         "dances.tsv: line 2: Ce?[2Jlia: has a control character in it"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(fault_of_corrections(c.text), c.fault) << c.text;
    }
    EXPECT_TRUE(fault_of_corrections(kColumns + std::string("../x\tC\t/a\t/a/1\n"))
                    .starts_with("dances.tsv: line 2: "));
}

TEST(DanceCorrectionsFile, that_is_cut_or_damaged_ends_in_one_line) {
    const std::string whole = two_songs().to_tsv();
    for (std::size_t end = 0; end <= whole.size(); ++end) {
        const std::string error = fault_of_corrections(whole.substr(0, end));
        EXPECT_TRUE(error.empty() || error.starts_with("dances.tsv: line ")) << error;
    }
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const std::string error =
            fault_of_corrections(test::mangled(whole, {.seed = seed, .bytes = 1 + seed % 7}));
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_TRUE(error.empty() || error.starts_with("dances.tsv: line ")) << error;
    }
}

TEST(DanceCorrections, never_grow_beyond_what_is_read) {
    DanceCorrections corrections;
    const std::string folder = "/" + std::string(200'000, 'a');
    for (int i = 0; i < 15; ++i) {
        ASSERT_TRUE(corrections.set({"salsa", "", folder, folder + "/" + std::to_string(i)}));
    }
    const std::string text = corrections.to_tsv();
    EXPECT_LE(text.size(), DanceCorrections::kMostBytes);
    const auto read = DanceCorrections::parse(text, "dances.tsv");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->all().size(), 10U);
    EXPECT_EQ(read->all().back().song, folder + "/14") << "the oldest went";
}

/// A person's folder of state, and a song in it.
class KeepDance : public ::testing::Test {
 protected:
    void SetUp() override {
        const char* const before = std::getenv("XDG_STATE_HOME");  // NOLINT(concurrency-mt-unsafe)
        before_ = before != nullptr ? before : "";
        setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
        fs::create_directories(folder_ / "Son");
        ASSERT_TRUE(write_file(folder_ / "Son" / "1.mp3", ""));
    }
    void TearDown() override {
        setenv("XDG_STATE_HOME", before_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    }

    [[nodiscard]] std::string keep(const std::string& dance,
                                   const std::string& artist,
                                   const fs::path& song) {
        return keep_dance(kept_, {dance, artist, song, known_});
    }
    static DanceCorrections in_file() {
        const auto corrections = DanceCorrections::load();
        EXPECT_TRUE(corrections) << corrections.error().message;
        return corrections.value_or(DanceCorrections());
    }

    test::TemporaryFolder folder_;
    std::string before_;
    std::vector<std::string> known_ = {"salsa", "belly"};
    KeptCorrections kept_{DanceCorrections()};
};

TEST_F(KeepDance, writes_it_and_says_for_what) {
    const fs::path song = fs::canonical(folder_ / "Son" / "1.mp3");
    const auto before = kept_.now();
    EXPECT_EQ(keep("salsa", "Celia", song), "salsa is kept for this song, and for Celia in Son");
    EXPECT_EQ(in_file().all(),
              (std::vector<DanceCorrection>{{"salsa", "Celia", song.parent_path(), song}}));
    EXPECT_EQ(kept_.now()->of_song(song), "salsa") << "without a new start";
    EXPECT_TRUE(before->all().empty()) << "who reads it meanwhile keeps what they have";
    EXPECT_EQ(keep("belly", "", song), "belly is kept for this song");
    EXPECT_EQ(in_file().all().size(), 1U);
}

TEST_F(KeepDance, keeps_what_another_program_wrote_meanwhile) {
    DanceCorrections other;
    ASSERT_TRUE(other.set({"belly", "", "/m", "/m/2.mp3"}));
    ASSERT_TRUE(other.save());
    EXPECT_EQ(keep("salsa", "", folder_ / "Son" / "1.mp3"), "salsa is kept for this song");
    EXPECT_EQ(in_file().all().size(), 2U);
}

TEST_F(KeepDance, says_why_nothing_is_kept) {
    const fs::path song = folder_ / "Son" / "1.mp3";
    EXPECT_EQ(keep("", "Celia", song), "no dance is kept: choose one first (D)");
    EXPECT_EQ(keep("tango", "Celia", song),
              "tango is not kept: no model tells it from music yet (raks train genre)");
    const std::string odd = keep("salsa", "", folder_ / "Son" / "a\tb.mp3");
    EXPECT_TRUE(odd.starts_with("salsa is not kept: ")) << odd;
    EXPECT_TRUE(odd.ends_with("a?b.mp3: has a control character in it")) << odd;
    EXPECT_FALSE(is_there(DanceCorrections::path()));
}

TEST_F(KeepDance, never_writes_over_a_bad_file) {
    fs::create_directories(DanceCorrections::path().parent_path());
    ASSERT_TRUE(write_file(DanceCorrections::path(), "a list of my own\n"));
    const std::string line = keep("salsa", "", folder_ / "Son" / "1.mp3");
    EXPECT_TRUE(line.starts_with("salsa is not kept: " + DanceCorrections::path().string() +
                                 ": line 1: must name the columns"))
        << line;
    EXPECT_EQ(read_file(DanceCorrections::path()).value_or(""), "a list of my own\n");
    EXPECT_TRUE(kept_.now()->all().empty());
}

}  // namespace
}  // namespace raks::engine
