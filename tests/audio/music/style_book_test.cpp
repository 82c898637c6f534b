// The styles of music as files: read as they are written, and every fault told in one line with its
// place.
#include "audio/music/styles/style_book.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audio/music/score/arrangement.hpp"
#include "audio/music/styles/general_midi_drums.hpp"
#include "audio/music/styles/style_book_reader.hpp"
#include "base/dice.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace raks::audio {
namespace {

using raks::test::replaced;

const std::string kRhythms = R"(format = "raks-styles"
version = 1

[[rhythm]]
name           = "habanera"
family         = "latin"
dance          = "tango"
use            = "held_out"
tempo          = [60, 92.5]
beats_per_bar  = 2
cell_beats     = 4
steps_per_beat = 4
bass           = ["habanera", "none"]
comping        = ["after_beats"]
weight         = 1.5
lanes = [
  { drum = "kick",  chance = 0.8, pattern = "X..xx.x.X..xx.x.|X.......o......." },
  { drum = 75, pattern = "x..x..x.x..x..x." },
]

[[rhythm]]
name           = "between"
family         = "pop"
tempo          = [100, 100]
beats_per_bar  = 3
cell_beats     = 3
steps_per_beat = 1
lanes = [ { drum = "snare", pattern = ".xx" } ]
)";

const std::string kPalettes = R"(format = "raks-styles"
version = 1
order = 3
beat_training = false

[[palette]]
dance       = "tango"
melody      = "long_notes"
bass        = [32, 43]
chords      = [0, 21]
leads       = [40]
kits        = [0]
band_chance = 0.7
lead_chance = 0.6
drumless_chance = 0.1
players     = { bass = 0.9, chords = 0.25, lead = 0 }

[[palette]]
dance  = "none"
melody = "any"
bass   = [33]
chords = [1]
leads  = [2]
kits   = [8]

[[rhythm]]
name           = "march"
family         = "ballroom"
dance          = "none"
tempo          = [90, 130]
beats_per_bar  = 2
cell_beats     = 2
steps_per_beat = 1
lanes = [ { drum = "kick", pattern = "xx" } ]
)";

const std::string kCorpus = R"(format = "raks-styles"
version = 1
order = 4
corpus_style = [ { name = "groove tango", dance = "tango" }, { name = "piano", dance = "none" } ]
)";

Expected<StyleBook> parse(const std::string& rhythms, const std::string& palettes = kPalettes) {
    return parse_styles(
        std::vector<StyleText>{
            {"rhythms.toml", rhythms}, {"palettes.toml", palettes}, {"corpus.toml", kCorpus}},
        "styles");
}

StyleBook small_book() {
    auto book = parse(kRhythms);
    EXPECT_TRUE(book) << book.error().message;
    return book ? std::move(*book) : StyleBook{};
}

std::vector<std::string> names_of(const std::vector<const RhythmStyle*>& rhythms) {
    std::vector<std::string> names;
    for (const RhythmStyle* rhythm : rhythms) {
        names.push_back(rhythm->name);
    }
    return names;
}

TEST(StyleBook, rhythms_are_read_as_they_are_written) {
    const StyleBook book = small_book();
    ASSERT_EQ(book.rhythms.size(), 3U);
    // The palettes' file comes first by its number.
    const RhythmStyle& rhythm = book.rhythms[1];
    EXPECT_EQ(rhythm.name, "habanera");
    EXPECT_EQ(rhythm.family, "latin");
    ASSERT_TRUE(rhythm.label);
    EXPECT_EQ(rhythm.label->dance, "tango");
    EXPECT_EQ(rhythm.label->use, DanceLabel::Use::held_out);
    EXPECT_TRUE(rhythm.is_for_beats);
    EXPECT_EQ(rhythm.lowest_bpm, 60.0);
    EXPECT_EQ(rhythm.highest_bpm, 92.5);
    EXPECT_EQ(rhythm.beats_per_bar, 2);
    EXPECT_EQ(rhythm.cell_beats, 4);
    EXPECT_EQ(rhythm.steps_per_beat, 4);
    EXPECT_EQ(rhythm.bass, (std::vector{BassLine::habanera, BassLine::none}));
    EXPECT_EQ(rhythm.comping, std::vector{Comping::after_beats});
    EXPECT_EQ(rhythm.weight, 1.5);
    ASSERT_EQ(rhythm.lanes.size(), 2U);
    EXPECT_EQ(rhythm.lanes[0].key, 36);
    EXPECT_EQ(rhythm.lanes[0].pattern, "X..xx.x.X..xx.x.|X.......o.......");
    EXPECT_EQ(rhythm.lanes[0].chance, 0.8);
    EXPECT_EQ(rhythm.lanes[1].key, 75);
    EXPECT_EQ(rhythm.lanes[1].chance, 1.0);
    EXPECT_FALSE(book.rhythms[2].label);
    EXPECT_TRUE(book.rhythms[2].bass.empty());
    EXPECT_FALSE(book.rhythms[0].is_for_beats);
    EXPECT_EQ(book.rhythms[0].label->dance, "");
}

TEST(StyleBook, palettes_are_read_as_they_are_written) {
    const StyleBook book = small_book();
    const BandPalette& palette = book.palette_of("tango");
    EXPECT_EQ(palette.melody, Melody::long_notes);
    EXPECT_EQ(palette.bass, (std::vector{32, 43}));
    EXPECT_EQ(palette.chords, (std::vector{0, 21}));
    EXPECT_EQ(palette.leads, std::vector{40});
    EXPECT_EQ(palette.kits, std::vector{0});
    EXPECT_EQ(palette.band_chance, 0.7);
    EXPECT_EQ(palette.lead_chance, 0.6);
    EXPECT_EQ(palette.drumless_chance, 0.1);
    EXPECT_EQ(palette.players.bass, 0.9);
    EXPECT_EQ(palette.players.chords, 0.25);
    EXPECT_EQ(palette.players.lead, 0.0);
    EXPECT_EQ(book.palette_of("").kits, std::vector{8});
    EXPECT_EQ(&book.palette_of("a dance without one"), &book.palette_of(""));
}

TEST(StyleBook, finds_rhythms_by_what_they_are_for) {
    const StyleBook book = small_book();
    EXPECT_EQ(names_of(book.rhythms_for("tango")), std::vector<std::string>{"habanera"});
    EXPECT_EQ(names_of(book.rhythms_for("")), std::vector<std::string>{"march"});
    EXPECT_TRUE(book.rhythms_for("salsa").empty());
    EXPECT_EQ(names_of(book.rhythms_for_beats()),
              (std::vector<std::string>{"habanera", "between"}));
}

TEST(StyleBook, tells_the_dance_of_what_the_beat_trackers_training_plays) {
    const StyleBook book = small_book();
    const struct {
        const char* name;
        std::optional<std::string> dance;
    } cases[] = {{"habanera", "tango"},
                 {"between", std::nullopt},
                 {"march", ""},
                 {"groove tango", "tango"},
                 {"groove tango-fast", "tango"},
                 {"groove tangos", std::nullopt},
                 {"piano", ""},
                 {"pian", std::nullopt},
                 {"", std::nullopt}};
    for (const auto& c : cases) {
        const auto label = book.label_of(c.name);
        EXPECT_EQ(label ? std::optional(label->dance) : std::nullopt, c.dance) << c.name;
    }
    EXPECT_EQ(book.label_of("habanera")->use, DanceLabel::Use::held_out);
}

TEST(StyleBook, tells_what_is_wrong_and_where) {
    const auto rhythm = [](const char* from, const char* to) {
        return parse(replaced(kRhythms, from, to));
    };
    const auto palette = [](const char* from, const char* to) {
        return parse(kRhythms, replaced(kPalettes, from, to));
    };
    const std::string in_rhythm = ": rhythm \"habanera\": ";
    const struct {
        Expected<StyleBook> book;
        std::string expected;
    } cases[] = {
        {parse(""), "rhythms.toml: line 1: needs format = \"raks-styles\""},
        {parse("[[#"), "rhythms.toml: line 1, column 3: '#' cannot stand here"},
        {parse("format = \"raks-styles\"\n"), "rhythms.toml: line 1: needs version = 1"},
        {rhythm("raks-styles", "raks-choreography"),
         "rhythms.toml: line 1: format must be \"raks-styles\""},
        {rhythm("version = 1", "version = 2"),
         "rhythms.toml: line 2: version must be a number up to 1; is Raks older than the file?"},
        {rhythm("version = 1", "version = \"1\""),
         "rhythms.toml: line 2: version must be a number up to 1; is Raks older than the file?"},
        {rhythm("[[rhythm]]", "[[rythm]]"),
         "rhythms.toml: line 4: key \"rythm\" is unknown; did you mean \"rhythm\"?"},
        {rhythm("version = 1", "version = 1\norder = 1.5"),
         "rhythms.toml: line 3: order is 1.5, must be a whole number"},
        {rhythm("version = 1", "version = 1\nbeat_training = 1"),
         "rhythms.toml: line 3: beat_training must be true or false"},
        {rhythm("version = 1", "version = 1\npalette = 3"),
         "rhythms.toml: line 3: palette must be tables, each under [[palette]]"},
        {rhythm("name           = \"habanera\"\n", ""),
         "rhythms.toml: line 4: needs name = \"...\""},
        {rhythm("\"habanera\"\n", "\"\"\n"),
         "rhythms.toml: line 5: name must have 1 to 64 letters and no control characters"},
        {rhythm("\"between\"", "\"habanera\""),
         "rhythms.toml: line 22" + in_rhythm + "is there twice, first in rhythms.toml, line 5"},
        {rhythm("\"between\"", "\"march\""),
         "rhythms.toml: line 22: rhythm \"march\": is there twice, first in palettes.toml, line "
         "27"},
        {rhythm("family ", "famly "),
         "rhythms.toml: line 6" + in_rhythm + "key \"famly\" is unknown; did you mean \"family\"?"},
        {rhythm("\"latin\"", "7"),
         "rhythms.toml: line 6" + in_rhythm + "family must be a text in quotes"},
        {rhythm("\"tango\"", "\"tengo\""),
         "rhythms.toml: line 7: no [[palette]] has this dance: dance \"tengo\" is unknown; did you "
         "mean \"tango\"?"},
        {rhythm("held_out", "heldout"),
         "rhythms.toml: line 8" + in_rhythm +
             "use \"heldout\" is unknown; did you mean \"held_out\"?"},
        {rhythm("dance          = \"tango\"\n", ""),
         "rhythms.toml: line 7" + in_rhythm +
             "use says how dance = \"...\" is used, which is not there"},
        {rhythm("[60, 92.5]", "[92.5, 60]"),
         "rhythms.toml: line 9" + in_rhythm + "tempo must rise: [lowest, highest]"},
        {rhythm("[60, 92.5]", "[60]"),
         "rhythms.toml: line 9" + in_rhythm + "tempo must be [lowest, highest]"},
        {rhythm("[60, 92.5]", "[6, 92.5]"),
         "rhythms.toml: line 9" + in_rhythm + "tempo is 6, must be 30 to 300"},
        {rhythm("tempo          = [60, 92.5]\n", ""),
         "rhythms.toml: line 4" + in_rhythm + "needs tempo = [lowest, highest]"},
        {rhythm("beats_per_bar  = 2", "beats_per_bar  = 0"),
         "rhythms.toml: line 10" + in_rhythm + "beats_per_bar is 0, must be 1 to 12"},
        {rhythm("beats_per_bar  = 2", "beats_per_bar  = 13"),
         "rhythms.toml: line 10" + in_rhythm + "beats_per_bar is 13, must be 1 to 12"},
        {rhythm("beats_per_bar  = 2", "beats_per_bar  = 2.5"),
         "rhythms.toml: line 10" + in_rhythm + "beats_per_bar is 2.5, must be a whole number"},
        {rhythm("beats_per_bar  = 2", "beats_per_bar  = 3"),
         "rhythms.toml: line 11" + in_rhythm + "cell_beats is 4, must be whole bars of 3 beats"},
        {rhythm("steps_per_beat = 4\n", ""),
         "rhythms.toml: line 4" + in_rhythm + "needs steps_per_beat = ..."},
        {rhythm("\"none\"]", "\"walkin\"]"),
         "rhythms.toml: line 13" + in_rhythm +
             "bass \"walkin\" is unknown; did you mean \"walking\"?"},
        {rhythm("[\"habanera\", \"none\"]", "[]"),
         "rhythms.toml: line 13" + in_rhythm + "bass must be 1 to 16 names, [\"...\"]"},
        {rhythm("after_beats", "afterbeat"),
         "rhythms.toml: line 14" + in_rhythm +
             "comping \"afterbeat\" is unknown; did you mean \"after_beats\"?"},
        {rhythm("[\"after_beats\"]", "[3]"),
         "rhythms.toml: line 14" + in_rhythm + "comping must be a text in quotes"},
        {rhythm("1.5", "0"),
         "rhythms.toml: line 15" + in_rhythm + "weight is 0, must be 0.01 to 100"},
        {rhythm("\"kick\"", "\"kck\""),
         "rhythms.toml: line 17" + in_rhythm + "drum \"kck\" is unknown; did you mean \"kick\"?"},
        {rhythm("drum = 75", "drum = 128"),
         "rhythms.toml: line 18" + in_rhythm + "drum is 128, must be 0 to 127"},
        {rhythm("drum = 75, ", ""), "rhythms.toml: line 18" + in_rhythm + "needs drum = \"...\""},
        {rhythm("drum = 75", "drums = 75"),
         "rhythms.toml: line 18" + in_rhythm + "key \"drums\" is unknown; did you mean \"drum\"?"},
        {rhythm("0.8", "1.2"),
         "rhythms.toml: line 17" + in_rhythm + "chance is 1.2, must be 0.01 to 1"},
        {rhythm("0.8", "-0.1"),
         "rhythms.toml: line 17" + in_rhythm + "chance is -0.1, must be 0.01 to 1"},
        {rhythm("0.8", "nan"),
         "rhythms.toml: line 17" + in_rhythm + "chance is nan, must be 0.01 to 1"},
        {rhythm("X.......o.......", "X.......o......"),
         "rhythms.toml: line 17" + in_rhythm +
             "row 2 of pattern: has 15 steps, must have 16: 4 beats of 4"},
        {rhythm("X.......o.......", "X.......O......."),
         "rhythms.toml: line 17" + in_rhythm +
             "row 2 of pattern: step 9 is \"O\", must be X, x, o or ."},
        {rhythm("|X.......o.......", "|"),
         "rhythms.toml: line 17" + in_rhythm +
             "row 2 of pattern: has 0 steps, must have 16: 4 beats of 4"},
        {rhythm("\"x..x..x.x..x..x.\"", "[]"),
         "rhythms.toml: line 18" + in_rhythm + "pattern must be a text in quotes"},
        {rhythm("[ { drum = \"snare\", pattern = \".xx\" } ]", "[]"),
         "rhythms.toml: line 28: rhythm \"between\": lanes must be 1 to 32 lanes, [{ drum = ... "
         "}]"},
        {rhythm("[ { drum = \"snare\", pattern = \".xx\" } ]", "[ \".xx\" ]"),
         "rhythms.toml: line 28: rhythm \"between\": a lane must be { drum = ..., chance = ..., "
         "pattern = \"...\" }"},
        {palette("\"tango\"", "\"\""),
         "palettes.toml: line 6: a palette needs dance = \"...\", or \"none\""},
        {palette("\"none\"", "\"tango\""),
         "palettes.toml: line 19: palette of \"tango\": is there twice, first in palettes.toml, "
         "line 7"},
        {palette("\"none\"", "\"other\""),
         "styles: no file has a [[palette]] with dance = \"none\""},
        {palette("long_notes", "long_note"),
         "palettes.toml: line 8: palette of \"tango\": melody \"long_note\" is unknown; did you "
         "mean \"long_notes\"?"},
        {palette("melody      = \"long_notes\"\n", ""),
         "palettes.toml: line 6: palette of \"tango\": needs melody = \"...\""},
        {palette("[32, 43]", "[32, 143]"),
         "palettes.toml: line 9: palette of \"tango\": bass is 143, must be 0 to 127"},
        {palette("[32, 43]", "[32, 4.5]"),
         "palettes.toml: line 9: palette of \"tango\": bass is 4.5, must be a whole number"},
        {palette("[0, 21]", "[]"),
         "palettes.toml: line 10: palette of \"tango\": chords must be 1 to 64 programs of General "
         "MIDI, from 0"},
        {palette("kits        = [0]\n", ""),
         "palettes.toml: line 6: palette of \"tango\": needs kits = [program, ...]"},
        {palette("0.7", "1.7"),
         "palettes.toml: line 13: palette of \"tango\": band_chance is 1.7, must be 0 to 1"},
        {palette("chords = 0.25", "chord = 0.25"),
         "palettes.toml: line 16: palette of \"tango\": key \"chord\" is unknown; did you mean "
         "\"chords\"?"},
        {palette("{ bass = 0.9, chords = 0.25, lead = 0 }", "0.9"),
         "palettes.toml: line 16: palette of \"tango\": players must be { bass = ..., chords = "
         "..., lead = ... }"},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(c.book ? "no error" : c.book.error().message, c.expected);
    }
}

TEST(StyleBook, tells_what_is_wrong_with_a_corpus_style) {
    const struct {
        const char* from;
        const char* to;
        const char* expected;
    } cases[] = {
        {", dance = \"none\"", "", "line 4: a corpus_style needs name = \"...\" and dance"},
        {"name = \"piano\"", "nam = \"piano\"", "line 4: key \"nam\" is unknown; did you mean"},
        {"dance = \"tango\"", "dance = \"Tengo\"", "line 4: no [[palette]] has this dance: dance"}};
    for (const auto& c : cases) {
        const auto book =
            parse_styles(std::vector<StyleText>{{"palettes.toml", kPalettes},
                                                {"corpus.toml", replaced(kCorpus, c.from, c.to)}},
                         "styles");
        ASSERT_FALSE(book) << c.expected;
        EXPECT_EQ(book.error().message.find(std::string("corpus.toml: ") + c.expected), 0U)
            << book.error().message;
    }
}

TEST(StyleBook, survives_every_cut_and_flipped_bytes) {
    const std::string good = kRhythms + kPalettes.substr(kPalettes.find("[[palette]]"));
    const auto check = [](const std::string& text) {
        const auto book = parse_styles(std::vector<StyleText>{{"x.toml", text}}, "styles");
        if (!book) {
            EXPECT_EQ(book.error().message.find('\n'), std::string::npos) << book.error().message;
            return;
        }
        // What is read can be written music from.
        for (const RhythmStyle& rhythm : book->rhythms) {
            Dice dice(1, 0);
            EXPECT_FALSE(arrange(*book, rhythm, 8, dice).bar_position.empty());
        }
    };
    check(good);
    for (std::size_t length = 0; length < good.size(); ++length) {
        check(good.substr(0, length));
    }
    constexpr std::uint64_t kFlips = 2000;
    for (std::uint64_t seed = 0; seed < kFlips; ++seed) {
        check(raks::test::mangled(good, {.seed = seed, .bytes = 1 + seed % 3}));
    }
}

TEST(StyleBook, a_folder_is_read_in_the_order_that_its_files_say) {
    const raks::test::TemporaryFolder folder;
    const std::string none = replaced(kPalettes, "order = 3\n", "");
    ASSERT_TRUE(write_file(folder / "a.toml", none));
    ASSERT_TRUE(
        write_file(folder / "b.toml", replaced(kRhythms, "version = 1", "version = 1\norder = 2")));
    ASSERT_TRUE(write_file(folder / "README.md", "no TOML"));
    const auto book = load_styles(folder.path());
    ASSERT_TRUE(book) << book.error().message;
    ASSERT_EQ(book->rhythms.size(), 3U);
    EXPECT_EQ(book->rhythms[0].name, "habanera");
    EXPECT_EQ(book->rhythms[2].name, "march") << "files without a number come last";
}

TEST(StyleBook, a_missing_or_empty_folder_is_one_line) {
    const raks::test::TemporaryFolder folder;
    const auto empty = load_styles(folder.path());
    ASSERT_FALSE(empty);
    EXPECT_EQ(
        empty.error().message,
        folder.path().string() + ": holds no .toml file, but styles of music are needed there");
    const auto missing = load_styles(folder / "none");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message,
              (folder / "none").string() + ": cannot be listed: No such file or directory");
    ASSERT_TRUE(write_file(folder / "huge.toml", std::string(2U << 20U, '#')));
    EXPECT_FALSE(load_styles(folder.path()));
}

TEST(StyleBook, has_a_fingerprint_of_all_that_it_says) {
    const StyleBook book = small_book();
    EXPECT_EQ(fingerprint(book), fingerprint(small_book()));
    for (const auto& [from, to] : {std::pair{"0.8", "0.81"},
                                   std::pair{"X.......o", "x.......o"},
                                   std::pair{"\"held_out\"", "\"always\""},
                                   std::pair{"92.5", "92"},
                                   std::pair{"\"none\"]", "\"walking\"]"}}) {
        const auto other = parse(replaced(kRhythms, from, to));
        ASSERT_TRUE(other) << other.error().message;
        EXPECT_NE(fingerprint(*other), fingerprint(book)) << from;
    }
}

TEST(Drums, have_each_a_name_and_a_key_of_their_own) {
    for (std::size_t i = 0; i < kDrumNames.size(); ++i) {
        EXPECT_EQ(kDrumNames.at(i).key, 35 + static_cast<int>(i));
        EXPECT_EQ(drum_key(kDrumNames.at(i).name), kDrumNames.at(i).key);
    }
    EXPECT_EQ(drum_key("kick"), 36);
    EXPECT_EQ(drum_key("anvil"), std::nullopt);
}

TEST(StyleBook, takes_the_rhythm_that_the_manual_adds) {
    const auto manual =
        read_text_file(std::filesystem::path(RAKS_SOURCE_DIR) / "docs" / "using" / "researcher.md",
                       std::size_t{1} << 20U);
    ASSERT_TRUE(manual) << manual.error().message;
    const std::size_t begin = manual->find("\n[[rhythm]]\n");
    ASSERT_NE(begin, std::string::npos);
    const std::string rhythm = manual->substr(begin, manual->find("\n]\n", begin) + 3 - begin);
    const auto book = parse_styles(
        std::vector<StyleText>{{"manual.toml", "format = \"raks-styles\"\nversion = 1\n" + rhythm},
                               {"palettes.toml", kPalettes}},
        "styles");
    ASSERT_TRUE(book) << book.error().message;
    EXPECT_EQ(names_of(book->rhythms_for("")), (std::vector<std::string>{"march", "go-go"}));
}

}  // namespace
}  // namespace raks::audio
