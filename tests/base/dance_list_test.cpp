// What dances.toml may say, what it may not, and the list that is made of it.
#include "base/dance_list.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/dances.hpp"
#include "tests/support/mangled.hpp"

namespace raks {
namespace {

const std::string kGood = R"(format = "raks-dances"
version = 1
pair = ["tango", "polka"]

[[dance]]
name = "tango"
title = "Tango"
beats_per_bar = 4
tempo = [56, 70]
likely_tempo = 62
roles = 2
style = "drums"
dress = "tails"
labels = ["milonga"]

[[dance]]
name = "polka"
beats_per_bar = 2
tempo = [100, 130]
)";

std::string replaced(const std::string& what, const std::string& with) {
    std::string text = kGood;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

std::string fault_of(const std::string& text) {
    const auto parsed = parse_dances(text, "x.toml", {"drums", "clicks"});
    EXPECT_FALSE(parsed) << text;
    return parsed ? "" : parsed.error().message;
}

TEST(DanceList, reads_what_each_dance_is) {
    const auto file = parse_dances(kGood, "x.toml");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->dances.size(), 2U);
    const DanceInfo& tango = file->dances[0];
    EXPECT_EQ(tango.title, "Tango");
    EXPECT_EQ(tango.lowest, Bpm(56.0));
    EXPECT_EQ(tango.highest, Bpm(70.0));
    EXPECT_EQ(tango.likely, Bpm(62.0));
    EXPECT_EQ(tango.roles, 2);
    EXPECT_EQ(tango.dress, "tails");
    EXPECT_EQ(tango.labels, std::vector<std::string>{"milonga"});
    const DanceInfo& polka = file->dances[1];
    EXPECT_EQ(polka.title, "polka") << "without a title its name";
    EXPECT_EQ(polka.beats_per_bar, 2);
    EXPECT_EQ(polka.likely, Bpm(115.0)) << "the middle of the range";
    EXPECT_EQ(file->pair, (std::vector<std::string>{"tango", "polka"}));
}

TEST(DanceList, what_is_written_reads_back) {
    auto file = parse_dances(kGood, "x.toml");
    ASSERT_TRUE(file) << file.error().message;
    file->dances[0].title = "\"Tango\" \\ argentino";
    file->dances[0].trials = DanceInfo::Trials::full;
    file->dances[0].is_fallback = true;
    file->dances[0].people_jerk_rms = {41.5, 33.25};
    file->dances[0].people_jerk_p999 = {180.0, 150.5};
    const std::string text = dances_text(*file);
    const auto again = parse_dances(text, "y.toml");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(dances_text(*again), text);
    EXPECT_EQ(again->dances[0].title, file->dances[0].title);
    EXPECT_TRUE(again->dances[0].is_fallback);
    EXPECT_FALSE(DanceInfo().is_fallback);
    EXPECT_EQ(again->dances[0].people_jerk_rms, file->dances[0].people_jerk_rms);
    EXPECT_EQ(again->dances[0].people_jerk_p999, file->dances[0].people_jerk_p999);
}

TEST(DanceList, every_fault_is_one_line_with_its_place) {
    const struct {
        std::string text;
        std::string fault;
    } cases[] = {
        {replaced("\"polka\"\nbeats", "\"tango\"\nbeats"),
         "x.toml: line 16: dance \"tango\" is there twice"},
        {replaced("beats_per_bar = 4", "beats_per_bar = 0"),
         "x.toml: line 8: beats_per_bar is 0, must be 2 to 12"},
        {replaced("[56, 70]", "[70, 56]"),
         "x.toml: line 9: tempo is [70, 56], the lowest must come first"},
        {replaced("[56, 70]", "[56]"), "x.toml: line 9: tempo must be [lowest, highest] in BPM"},
        {replaced("likely_tempo = 62", "likely_tempo = 90"),
         "x.toml: line 10: likely_tempo is 90, must be 56 to 70"},
        {replaced("style = \"drums\"", "style = \"drum\""),
         "x.toml: line 12: style \"drum\" is unknown; did you mean \"drums\"?"},
        {replaced("roles = 2", "roles = 3"), "x.toml: line 11: roles is 3, must be 1 to 2"},
        {replaced("title", "titel"),
         "x.toml: line 7: key \"titel\" is unknown; did you mean \"title\"?"},
        {replaced("\"tango\"\ntitle", "\"../tango\"\ntitle"),
         "x.toml: line 5: name: \"../tango\" cannot name a dance: letters a-z, digits, '-' and "
         "'_', 1 to 40 of them"},
        {replaced("\"tango\"\ntitle", "\"keep\"\ntitle"),
         "x.toml: line 5: name: \"keep\" cannot name a dance: it means something else here"},
        {replaced("version = 1", "version = 2"),
         "x.toml: version must be a number up to 1; is Raks older than the file?"},
        {replaced("raks-dances", "raks-dance"), "x.toml: format must be \"raks-dances\""},
        {"format = \"raks-dances\"\nversion = 1\n", "x.toml: needs at least one [[dance]]"},
        {"[]\n",
         "x.toml: line 1, column 2: Error while parsing table header: tables with blank bare keys "
         "are "
         "explicitly prohibited"},
    };
    for (const auto& one : cases) {
        EXPECT_EQ(fault_of(one.text), one.fault) << one.text;
    }
}

TEST(DanceList, names_are_parts_of_files_names_on_any_system) {
    for (const char* const good : {"tango", "Tango-2", "a", "west_coast_swing", "2step"}) {
        EXPECT_TRUE(is_dance_name(good)) << good;
    }
    for (const std::string bad : {"",
                                  "..",
                                  "a/b",
                                  "a b",
                                  "tängo",
                                  "-x",
                                  "auto",
                                  "unknown",
                                  "dances",
                                  "a.toml",
                                  "con\n",
                                  "a\\b"}) {
        EXPECT_FALSE(is_dance_name(bad)) << bad;
    }
    EXPECT_FALSE(is_dance_name(std::string(41, 'a')));
}

TEST(DanceList, names_are_made_of_any_text) {
    const std::pair<const char*, const char*> cases[] = {
        {"one go", "one_go"},
        {"Hip Hop Dancing (2)", "Hip_Hop_Dancing_2"},
        {"mixamo.com", "mixamo_com"},
        {"-x- ", "x"},
        {"west_coast-swing", "west_coast-swing"},
        {"täng\xC3\xB6", "t_ng"},
        {"auto", "dance_auto"},
        {"dances", "dance_dances"},
        {"\xE8\x88\x9E", "dance"},
        {"", "dance"},
    };
    for (const auto& [text, name] : cases) {
        EXPECT_EQ(made_dance_name(text), name) << text;
        EXPECT_TRUE(is_dance_name(made_dance_name(text))) << text;
    }
    EXPECT_TRUE(is_dance_name(made_dance_name(std::string(39, 'a') + " b")));
}

TEST(DanceList, finds_dances_by_name_and_number) {
    const auto dances = test::shipped_dances();
    ASSERT_GE(dances->size(), 6U);
    EXPECT_EQ(dances->id_of("waltz"), shipped::waltz);
    EXPECT_EQ(dances->name_of(shipped::hiphop), "hiphop");
    EXPECT_EQ(dances->title_of(shipped::hiphop), "Hip-hop");
    EXPECT_EQ(dances->id_of("no_such_dance"), DanceId::none);
    EXPECT_EQ(dances->name_of(DanceId::none), "unknown");
    EXPECT_EQ(dances->find(static_cast<DanceId>(dances->size())), nullptr);
    EXPECT_EQ(dances->find(shipped::waltz)->beats_per_bar, 3);
}

TEST(DanceList, mangled_files_are_refused_or_read) {
    for (std::uint64_t seed = 1; seed <= 2'000; ++seed) {
        const std::string text = test::mangled(kGood, {.seed = seed, .bytes = 1 + seed % 6});
        const auto parsed = parse_dances(text, "x.toml");
        if (parsed) {
            for (const DanceInfo& dance : parsed->dances) {
                EXPECT_TRUE(is_dance_name(dance.name)) << seed;
                EXPECT_LE(dance.lowest, dance.highest) << seed;
                EXPECT_TRUE(dance.beats_per_bar >= 2 && dance.beats_per_bar <= 12) << seed;
            }
        } else {
            EXPECT_EQ(parsed.error().message.find('\n'), std::string::npos) << seed;
        }
    }
}

}  // namespace
}  // namespace raks
