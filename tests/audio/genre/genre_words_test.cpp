#include "audio/genre/genre_words.hpp"

#include <gtest/gtest.h>

#include "tests/base/source_tree.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio {
namespace {

using Parts = std::vector<std::vector<std::string>>;
using Place = GenreWords::Place;

const std::vector<std::string_view> kDances = {"samba", "polka"};

std::string fault_of(std::string_view rows) {
    const auto read = parse_genre_words(
        "format = \"raks-genres\"\nversion = 1\n" + std::string(rows), "x.toml", kDances);
    return read ? std::string() : read.error().message;
}

GenreWords words_of(std::string_view rows, GenreWords under = {}) {
    auto read = parse_genre_words("format = \"raks-genres\"\nversion = 1\n" + std::string(rows),
                                  "x.toml",
                                  kDances,
                                  std::move(under));
    EXPECT_TRUE(read) << read.error().message;
    return read ? *read : GenreWords();
}

std::string dance_of(const GenreWords& table, std::string_view text, Place place = Place::genre) {
    const auto parts = parts_of(text);
    return parts.empty() ? std::string()
                         : std::string(table.longest(place, parts.front(), 0).dance);
}

TEST(GenreWords, are_compared_without_what_people_write_differently) {
    const struct {
        std::string_view text;
        Parts parts;
    } cases[] = {
        {"", {}},
        {" ;,/ ", {}},
        {"Hip-Hop/R&B", {{"hip", "hop"}, {"r", "and", "b"}}},
        {"Electronic; House", {{"electronic"}, {"house"}}},
        {"a\\b|c,d\ne", {{"a"}, {"b"}, {"c"}, {"d"}, {"e"}}},
        {std::string_view("a\0b", 3), {{"a"}, {"b"}}},
        {"a?b", {{"a"}, {"b"}}},  // a zero that was made printable
        {"(17)Rock", {{"17"}, {"rock"}}},
        {"(255)", {{"255"}}},
        {"E.D.M.", {{"edm"}}},
        {"rock'n'roll", {{"rock", "n", "roll"}}},
        {"Música ÉLECTRONIQUE", {{"musica", "electronique"}}},
        {"Mu\xCC\x81sica", {{"musica"}}},  // the accent behind its letter
        {"ВАЛЬС Ёлка", {{"вальс", "ёлка"}}},
        {"ΒΑΛΣ", {{"βαλσ"}}},
        {"サルサ・ラテン", {{"サルサ", "ラテン"}}},
        {"a\xFF\xFE b\xC3", {{"a", "b"}}},
        {"a \xE2\x80\xA2 b", {{"a", "b"}}},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(parts_of(c.text), c.parts) << c.text;
    }
}

TEST(GenreWords, the_longest_row_counts) {
    const GenreWords table = words_of(
        "[genre]\n\"folk\" = \"polka\"\n\"folk dance\" = \"samba\"\n\"folk dance group\" = "
        "\"none\"\n[title]\n\"folk\" = \"fallback\"\n");
    EXPECT_EQ(dance_of(table, "Folk"), "polka");
    EXPECT_EQ(dance_of(table, "FOLK-DANCE of old"), "samba");
    EXPECT_EQ(dance_of(table, "folk dance group"), "none");
    EXPECT_EQ(dance_of(table, "dance"), "");
    EXPECT_EQ(dance_of(table, "folk dance", Place::title), "fallback");
    EXPECT_EQ(dance_of(table, "folk", Place::number), "");
}

TEST(GenreWords, rows_of_a_persons_own_table_win) {
    const GenreWords shipped = words_of("[genre]\na = \"polka\"\nb = \"polka\"\n");
    const GenreWords own = words_of("[genre]\n\"Á\" = \"samba\"\nc = \"none\"\n", shipped);
    EXPECT_EQ(dance_of(own, "a"), "samba");
    EXPECT_EQ(dance_of(own, "b"), "polka");
    EXPECT_EQ(own.size(Place::genre), 3U);
}

TEST(GenreWords, a_bad_table_is_refused_with_its_line) {
    const struct {
        const char* rows;
        const char* fault;
    } cases[] = {
        {"[genre]\na = \"smaba\"\n",
         "x.toml: line 4: \"a\": dance \"smaba\" is unknown; did you mean \"samba\"?"},
        {"[genre]\na = 3\n", "x.toml: line 4: \"a\": dance must be a text in quotes"},
        {"[genre]\n\"hip-hop\" = \"samba\"\n\"Hip Hop\" = \"polka\"\n",
         "x.toml: line 5: \"Hip Hop\": is the same as the row of line 4"},
        {"[genre]\n\" - \" = \"samba\"\n", "x.toml: line 4: \" - \": must be one word or phrase"},
        {"[genre]\n\"a;b\" = \"samba\"\n", "x.toml: line 4: \"a;b\": must be one word or phrase"},
        {"[gerne]\n", "x.toml: line 3: key \"gerne\" is unknown; did you mean \"genre\"?"},
        {"genre = 1\n", "x.toml: line 3: genre must be a table"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(fault_of(c.rows), c.fault) << c.rows;
    }
    // TOML itself sees the same letters twice.
    const std::string twice = fault_of("[genre]\na = \"samba\"\na = \"polka\"\n");
    EXPECT_NE(twice.find("x.toml: line 5"), std::string::npos) << twice;
    EXPECT_EQ(parse_genre_words("format = \"other\"\n", "x.toml", kDances).error().message,
              "x.toml: format must be \"raks-genres\"");
    EXPECT_NE(load_genre_words("none.toml", kDances).error().message.find("none.toml"),
              std::string::npos);
}

TEST(GenreWords, the_shipped_table_says_dances_that_there_are) {
    const auto dances = raks::test::shipped_dances();
    const auto read =
        load_genre_words(raks::test::kSourceTree / "config" / "genres.toml", dances->names());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_GT(read->size(Place::genre), 200U);
    EXPECT_GT(read->size(Place::title), 30U);
    EXPECT_GT(read->size(Place::number), 50U);
    const struct {
        const char* text;
        const char* dance;
    } cases[] = {
        {"Salsa", "salsa"},     {"Son Cubano", "salsa"},   {"Guaguanco", "salsa"},
        {"BACHATA", "salsa"},   {"Belly-Dance", "belly"},  {"Arabic Pop", "belly"},
        {"Bauchtanz", "belly"}, {"Deep House", "house"},   {"Électronique", "house"},
        {"Dance", "house"},     {"Hip-Hop", "hiphop"},     {"R&B", "hiphop"},
        {"Rap", "hiphop"},      {"Punk", "rock"},          {"Rock 'n' Roll", "rock"},
        {"Walzer", "waltz"},    {"Вальс", "waltz"},        {"ワルツ", "waltz"},
        {"Disco", "fallback"},  {"Dancehall", "fallback"}, {"Pop Rock", "fallback"},
        {"Soundtrack", ""},     {"Hörbuch", ""},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(dance_of(*read, c.text), c.dance) << c.text;
    }
    EXPECT_EQ(dance_of(*read, "17", Place::number), "rock");
    EXPECT_EQ(dance_of(*read, "143", Place::number), "salsa");
    EXPECT_EQ(dance_of(*read, "House of Cards", Place::title), "");
}

}  // namespace
}  // namespace raks::audio
