// The grammar's file: what is written there is read, and every fault is told in one line.
#include "motion/figures/figure_grammar.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/figures/dance_habits_reader.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion {
namespace {

const std::string kGood = R"(format = "raks-dance"
version = 1
dance = "salsa"
[[figure]]
name = "basic"
energy = 0.2
after = { turn = 3, basic = 1 }
[[figure]]
name = "turn"
after = { basic = 1.5 }
)";

std::string replaced(const std::string& what, const std::string& with) {
    std::string text = kGood;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

TEST(FigureGrammar, reads_figures_energies_and_weights) {
    const auto grammar = parse_grammar(kGood, "x.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_EQ(grammar->dance, "salsa");
    ASSERT_EQ(grammar->rules.size(), 2U);
    EXPECT_EQ(grammar->rules[0].figure, "basic");
    EXPECT_EQ(grammar->rules[0].energy, 0.2);
    EXPECT_EQ(grammar->rules[0].after, (std::vector<double>{1.0, 3.0}));
    EXPECT_EQ(grammar->rules[1].energy, 0.5);
    EXPECT_EQ(grammar->rules[1].after, (std::vector<double>{1.5, 0.0}));
}

TEST(FigureGrammar, reads_how_far_a_couple_goes_aside) {
    const auto grammar = parse_grammar(
        replaced("energy = 0.2", "lead_aside = [-0.2, 0.1]\nfollow_aside = [0.3, 0]"), "x.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_EQ(grammar->rules[0].aside[0], glm::dvec2(-0.2, 0.1));
    EXPECT_EQ(grammar->rules[0].aside[1], glm::dvec2(0.3, 0.0));
    EXPECT_EQ(grammar->rules[1].aside[1], glm::dvec2(0.0));
    for (const char* const bad : {"[2, 0]", "[0.1]", "0.1", "[nan, 0]", "[\"a\", 0]"}) {
        const auto refused =
            parse_grammar(replaced("energy = 0.2", std::string("lead_aside = ") + bad), "x.toml");
        ASSERT_FALSE(refused) << bad;
        EXPECT_NE(refused.error().message.find("lead_aside must be [left, forward]"),
                  std::string::npos)
            << refused.error().message;
    }
}

TEST(FigureGrammar, reads_what_dancers_do_beside_the_figures) {
    const std::string head = "dance = \"salsa\"\n";
    const auto read = [&](const std::string& lines) {
        return parse_grammar(replaced(head, head + lines), "x.toml");
    };
    const auto plain = read("");
    ASSERT_TRUE(plain) << plain.error().message;
    EXPECT_EQ(plain->habits.pauses, DanceHabits().pauses) << "as if nothing were said";
    const auto own =
        read("pauses = 0.8\nrests = 0\nrest_at = [\"waist\", \"low\"]\nmirror = 0.4\n");
    ASSERT_TRUE(own) << own.error().message;
    EXPECT_EQ(own->habits.pauses, 0.8);
    EXPECT_EQ(own->habits.rests, 0.0);
    EXPECT_EQ(plain->habits.mirror, 0.0);
    EXPECT_EQ(own->habits.mirror, 0.4);
    EXPECT_EQ(own->habits.rest_at, (std::vector<HandPlace>{HandPlace::waist, HandPlace::low}));
    for (const auto& [lines, what] : std::vector<std::pair<std::string, std::string>>{
             {"pauses = 1.5\n", "x.toml: pauses must be a number from 0 to 1"},
             {"pauses = nan\n", "x.toml: pauses must be a number from 0 to 1"},
             {"rests = \"often\"\n", "x.toml: rests must be a number from 0 to 1"},
             {"mirror = true\n", "x.toml: mirror must be a number from 0 to 1"},
             {"rest_at = []\n", "x.toml: rest_at must be a list of one or more places"},
             {"rest_at = \"hip\"\n", "x.toml: rest_at must be a list of one or more places"},
             {"rest_at = [\"hipp\"]\n", "did you mean \"hip\"?"}}) {
        const auto refused = read(lines);
        ASSERT_FALSE(refused) << lines;
        EXPECT_NE(refused.error().message.find(what), std::string::npos) << refused.error().message;
    }
}

TEST(FigureGrammar, reads_endings_and_idle_movements_and_goes_on_without_what_it_does_not_know) {
    const std::string head = "dance = \"salsa\"\n";
    const auto read = [&](const std::string& lines) {
        const auto grammar = parse_grammar(replaced(head, head + lines), "x.toml");
        EXPECT_TRUE(grammar) << lines << grammar.error().message;
        return grammar ? grammar->habits : DanceHabits();
    };
    const DanceHabits own = read("endings = [\"nod\", \"bow\"]\nidle = [\"bang\"]\n");
    EXPECT_EQ(own.endings, (std::vector<Ending>{Ending::nod, Ending::bow}));
    EXPECT_EQ(own.idle, (std::vector<IdleMove>{IdleMove::bang}));
    EXPECT_TRUE(own.notes.empty());
    EXPECT_TRUE(read("endings = []\n").endings.empty()) << "only stands";
    struct Row {
        std::string lines;
        std::string note;
        std::vector<Ending> endings;
    };
    for (const Row& row : std::vector<Row>{
             {"endings = [\"bov\", \"wave\", \"wave\"]\n", "did you mean \"bow\"?", {Ending::wave}},
             {"endings = [7]\n", "x.toml: endings", {}},
             {"endings = \"bow\"\n", "must be a list of names", DanceHabits().endings},
             {"idle = [\"tapp\"]\n", "did you mean \"tap\"?", DanceHabits().endings},
             {"idle = 3\n", "x.toml: idle must be a list of names", DanceHabits().endings}}) {
        const DanceHabits habits = read(row.lines);
        ASSERT_EQ(habits.notes.size(), 1U) << row.lines;
        EXPECT_NE(habits.notes[0].find(row.note), std::string::npos) << habits.notes[0];
        EXPECT_EQ(habits.notes[0].find('\n'), std::string::npos);
        EXPECT_EQ(habits.endings, row.endings) << row.lines;
    }
}

TEST(FigureGrammar, reads_what_hands_do_and_goes_on_without_what_is_wrong) {
    const auto read = [](const std::string& head, const std::string& figure) {
        std::string text = replaced("version = 1\n", "version = 1\n" + head);
        const std::size_t at = text.find("[[figure]]\n") + 11;
        return parse_grammar(text.insert(at, figure), "x.toml");
    };
    const auto weight = [](const HandShapeWeights& weights, HandShape shape) {
        return weights[static_cast<std::size_t>(shape)];
    };
    const auto own = read("hands = { every = 8, shapes = { fist = 2, long = 0.5 } }\n",
                          "hands = \"zills\"\nstill = \"head\"\n");
    ASSERT_TRUE(own) << own.error().message;
    EXPECT_EQ(own->habits.hands.every, 8);
    EXPECT_EQ(weight(own->habits.hands.shapes, HandShape::fist), 2.0F);
    EXPECT_EQ(weight(own->habits.hands.shapes, HandShape::lengthy), 0.5F);
    EXPECT_EQ(weight(own->habits.hands.shapes, HandShape::danced), 0.0F);
    ASSERT_TRUE(own->rules[0].hands);
    EXPECT_EQ(weight(*own->rules[0].hands, HandShape::zills), 1.0F);
    EXPECT_EQ(own->rules[0].still, StillPart::head);
    EXPECT_FALSE(own->rules[1].hands) << "where nothing is said";
    EXPECT_EQ(own->rules[1].still, StillPart::nothing);
    for (const std::string mangled : {"hands = 3\n",
                                      "hands = { every = 0 }\n",
                                      "hands = { shapes = { fsit = 1 } }\n",
                                      "hands = { shapes = { fist = -1 } }\n",
                                      "hands = { shapes = 7 }\n",
                                      "hands = { shape = \"fist\" }\n"}) {
        const auto without = read(mangled, "hands = [1]\n");
        ASSERT_TRUE(without) << mangled << without.error().message;
        EXPECT_EQ(without->habits.hands.shapes, HandHabits().shapes) << mangled;
        EXPECT_EQ(without->habits.hands.every, HandHabits().every) << mangled;
        EXPECT_FALSE(without->rules[0].hands);
    }
    const auto refused = read("", "still = \"haed\"\n");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("did you mean \"head\"?"), std::string::npos)
        << refused.error().message;
}

TEST(DanceHabits, of_a_file_without_figures_say_what_is_wrong_of_hands_in_a_line_each) {
    const raks::test::TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "x.toml";
    const auto read = [&](const std::string& text) {
        std::ofstream(path) << text;
        return habits_of_file(path);
    };
    const auto good = read("rests = 0.1\n[hands]\nshapes = \"open\"\n");
    ASSERT_TRUE(good) << good.error().message;
    EXPECT_FALSE(good->has_figures);
    EXPECT_TRUE(good->habits.notes.empty());
    EXPECT_EQ(good->habits.rests, 0.1);
    EXPECT_EQ(good->habits.hands.shapes[static_cast<std::size_t>(HandShape::open)], 1.0F);
    const auto mangled =
        read("[hands]\nshapes = { fsit = 1, open = 1 }\nevery = \"bar\"\n[[figure]]\nhands = 1\n");
    ASSERT_TRUE(mangled) << mangled.error().message;
    EXPECT_TRUE(mangled->has_figures);
    EXPECT_EQ(mangled->habits.hands.shapes[static_cast<std::size_t>(HandShape::open)], 1.0F);
    ASSERT_EQ(mangled->habits.notes.size(), 3U);
    std::string all;
    for (const std::string& fault : mangled->habits.notes) {
        all += fault + '\n';
    }
    EXPECT_NE(all.find(path.string() + ": line 2: hands: "), std::string::npos) << all;
    EXPECT_NE(all.find("did you mean \"fist\"?"), std::string::npos) << all;
    EXPECT_NE(all.find("every must be a number from 1 to 64"), std::string::npos) << all;
    EXPECT_NE(all.find("line 5: hands: shapes must be a name"), std::string::npos) << all;
    EXPECT_FALSE(read("hands = [\n"));
}

TEST(FigureGrammar, reads_which_figures_stay_on_their_side) {
    const auto with = [](const std::string& line) {
        return parse_grammar(replaced("[[figure]]\n", "[[figure]]\n" + line), "x.toml");
    };
    const auto one_sided = with("mirror = false\n");
    ASSERT_TRUE(one_sided) << one_sided.error().message;
    EXPECT_FALSE(one_sided->rules[0].can_mirror);
    EXPECT_TRUE(one_sided->rules[1].can_mirror) << "where nothing is said";
    const auto refused = with("mirror = 0.5\n");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("mirror must be true or false"), std::string::npos)
        << refused.error().message;
}

TEST(FigureGrammar, reads_how_a_couple_holds) {
    const auto with = [](const std::string& couple, const std::string& holds) {
        std::string text = replaced("[[figure]]", "[couple]\n" + couple + "\n[[figure]]");
        text.replace(text.find("energy = 0.2"), 12, holds);
        return parse_grammar(text, "x.toml");
    };
    EXPECT_FALSE(parse_grammar(kGood, "x.toml")->couple);
    const auto grammar =
        with("hold = \"hands\"\napart = [-0.1, 0.5]",
             "holds = [{ lead = \"right\", follow = \"left\", from = 0.5, to = 4 }]");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_EQ(grammar->couple->hold, CoupleHold::hands);
    EXPECT_EQ(grammar->couple->apart, glm::dvec2(-0.1, 0.5));
    ASSERT_EQ(grammar->rules[0].holds.size(), 1U);
    EXPECT_EQ(grammar->rules[0].holds[0].lead, Side::right);
    EXPECT_EQ(grammar->rules[0].holds[0].follow, Side::left);
    EXPECT_EQ(grammar->rules[0].holds[0].from, 0.5);
    EXPECT_EQ(grammar->rules[0].holds[0].to, 4.0);
    EXPECT_TRUE(grammar->notes.empty());
}

TEST(FigureGrammar, a_hold_that_is_none_is_left_out_with_one_line) {
    struct Case {
        std::string couple;
        std::string holds;
        std::string note;
    };
    const std::string no_hold =
        "a hold needs lead and follow, \"left\" or \"right\", and from < to, beats from 0 to 64; "
        "the "
        "figure is danced without it";
    const std::vector<Case> cases = {
        {"hold = \"tight\"",
         "",
         "hold \"tight\" is unknown; known: none, hands, closed; the couple dances without a hold"},
        {"apart = [0, 1]",
         "",
         "hold \"\" is unknown; known: none, hands, closed; the couple dances without a hold"},
        {"hold = \"none\"\napart = [99, 0]",
         "",
         "apart must be [left, forward] in metres, each up to 10; it is ignored"},
        {"hold = \"closed\"\nhips = \"near\"",
         "",
         "hips must be [left, forward] in metres, each up to 1; it is ignored"},
        {"hold = \"closed\"\nclasp = nan",
         "",
         "clasp must be a number over 0, up to 1.5; it is ignored"},
        {"hold = \"closed\"\ncontacts = 3",
         "",
         "contacts must be a list of at most 4 tables; it is ignored"},
        {"hold = \"closed\"\ncontacts = [{ who = \"lead\", hand = \"right\", on = \"waste\", side "
         "= "
         "\"left\" }]",
         "",
         "on \"waste\" is unknown; did you mean \"waist\"?; the couple dances without this "
         "contact"},
        {"hold = \"hands\"", "holds = [3]", no_hold},
        {"hold = \"hands\"", "holds = [{}]", no_hold},
        {"hold = \"hands\"",
         "holds = [{ lead = \"left\", follow = \"left\", from = 2, to = 1 }]",
         no_hold},
        {"hold = \"hands\"",
         "holds = 3",
         "holds must be a list of at most 32 tables; the figure is danced without"},
    };
    for (const Case& one : cases) {
        std::string text = replaced("[[figure]]", "[couple]\n" + one.couple + "\n[[figure]]");
        text.replace(text.find("energy = 0.2"), 12, one.holds);
        const auto grammar = parse_grammar(text, "x.toml");
        ASSERT_TRUE(grammar) << grammar.error().message;
        ASSERT_EQ(grammar->notes.size(), 1U) << one.couple << one.holds;
        EXPECT_NE(grammar->notes[0].find(one.note), std::string::npos) << grammar->notes[0];
        EXPECT_EQ(grammar->notes[0].find("x.toml: line "), 0U) << grammar->notes[0];
        EXPECT_TRUE(grammar->rules[0].holds.empty());
    }
}

TEST(FigureGrammar, reads_the_contact_points_of_a_closed_hold) {
    const auto grammar = parse_grammar(
        replaced("[[figure]]",
                 "[couple]\nhold = \"closed\"\nhips = [-0.1, 0.3]\nclasp = 0.9\nlook = [0, 90]\n"
                 "contacts = [{ who = \"follow\", hand = \"left\", on = \"shoulder\", side = "
                 "\"right\" }]\n[[figure]]"),
        "x.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    const ClosedFrame& frame = grammar->couple->frame;
    EXPECT_EQ(frame.hips, glm::dvec2(-0.1, 0.3));
    EXPECT_EQ(frame.clasp, 0.9);
    EXPECT_EQ(grammar->notes.size(), 1U) << "90 degrees is more than a head turns";
    EXPECT_FALSE(frame.laid[0][1]);
    ASSERT_TRUE(frame.laid[1][0]);
    EXPECT_EQ(frame.laid[1][0]->on, HoldPlace::shoulder);
    EXPECT_EQ(frame.laid[1][0]->side, Side::right);
}

TEST(FigureGrammar, reads_the_arms_of_one_alone) {
    const auto with = [](const std::string& solo) {
        return parse_grammar(replaced("[[figure]]", "[solo]\n" + solo + "\n[[figure]]"), "x.toml");
    };
    const auto grammar = with(
        "beats = 4\n[[solo.arms]]\nleft = [[1, 0.1, -0.5, 0.4]]\nright = [[2, 0.1, -0.5, 0.4], [3, "
        "0, 0.5, 0.4]]");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_TRUE(grammar->notes.empty());
    EXPECT_EQ(grammar->solo.beats, 4.0);
    ASSERT_EQ(grammar->solo.patterns.size(), 1U);
    EXPECT_EQ(grammar->solo.patterns[0].keys[1][1].wrist, glm::vec3(0.0F, 0.5F, 0.4F));
    for (const char* const bad : {"arms = 3",
                                  "[[solo.arms]]\nleft = [[1, 0, 0, 0]]",
                                  "[[solo.arms]]\nleft = [[1, 0, 0, 0]]\nright = [[2, 0, 0, 9]]",
                                  "[[solo.arms]]\nleft = [[2, 0, 0, 0], [1, 0, 0, 0]]\nright = "
                                  "[[2, 0, 0, 0]]"}) {
        const auto without = with(bad);
        ASSERT_TRUE(without) << without.error().message;
        EXPECT_EQ(without->notes.size(), 1U) << bad;
        EXPECT_TRUE(without->solo.patterns.empty()) << bad;
    }
}

TEST(FigureGrammar, reads_where_figures_start) {
    const auto common = parse_grammar(kGood, "x.toml");
    ASSERT_TRUE(common);
    EXPECT_EQ(common->starts, FigureGrammar::Starts::common);
    const auto own = parse_grammar(
        replaced("dance = \"salsa\"", "dance = \"salsa\"\nstarts = \"own\""), "x.toml");
    ASSERT_TRUE(own) << own.error().message;
    EXPECT_EQ(own->starts, FigureGrammar::Starts::own);
    for (const char* const bad : {"\"mine\"", "1", "\"\""}) {
        const auto refused = parse_grammar(
            replaced("dance = \"salsa\"", std::string("dance = \"salsa\"\nstarts = ") + bad),
            "x.toml");
        ASSERT_FALSE(refused) << bad;
        EXPECT_NE(refused.error().message.find("starts must be"), std::string::npos);
    }
}

TEST(FigureGrammar, the_shipped_one_is_read) {
    const auto grammar = load_grammar(std::string(RAKS_SOURCE_DIR) + "/models/trained/salsa.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_EQ(grammar->rules.size(), 4U);
}

TEST(FigureGrammar, tells_what_is_wrong_and_where) {
    const struct {
        std::string text;
        const char* expected;
    } cases[] = {{"", "format must be"},
                 {"[[", "line 1"},
                 {"[[[figure]]]", "line 1"},
                 {"[=", "line 1"},
                 {replaced("raks-dance", "raks-danse"), "format must be \"raks-dance\""},
                 {replaced("version = 1", "version = 2"), "version"},
                 {replaced("dance = \"salsa\"", ""), "needs dance"},
                 {replaced("energy", "enegry"), "did you mean \"energy\"?"},
                 {replaced("turn = 3", "tunr = 3"), "did you mean \"turn\"?"},
                 {replaced("name = \"turn\"", "name = \"basic\""), "twice"},
                 {replaced("name = \"turn\"", ""), "needs a name"},
                 {replaced("energy = 0.2", "energy = 2"), "from 0 to 1"},
                 {replaced("energy = 0.2", "energy = nan"), "from 0 to 1"},
                 {replaced("turn = 3", "turn = -3"), "must be a number >= 0"},
                 {replaced("turn = 3", "turn = \"x\""), "must be a number >= 0"},
                 {replaced("basic = 1.5", "basic = 0"), "nothing comes after"}};
    for (const auto& c : cases) {
        const auto grammar = parse_grammar(c.text, "x.toml");
        ASSERT_FALSE(grammar) << c.text;
        const std::string& message = grammar.error().message;
        EXPECT_NE(message.find(c.expected), std::string::npos) << message;
        EXPECT_EQ(message.find("x.toml"), 0U) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(FigureGrammar, survives_every_cut_and_flipped_bytes) {
    for (std::size_t length = 0; length < kGood.size(); ++length) {
        const auto grammar = parse_grammar(kGood.substr(0, length), "x.toml");
        EXPECT_TRUE(grammar || grammar.error().message.find('\n') == std::string::npos);
    }
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const auto grammar = parse_grammar(raks::test::mangled(kGood, {.seed = seed}), "x.toml");
        EXPECT_TRUE(grammar || grammar.error().message.find('\n') == std::string::npos);
    }
}

const std::string kSeen = R"(format = "raks-dance"
version = 1
dance = "tango"
[[figure]]
name = "walk"
seen = 6
[[figure]]
name = "ocho"
seen = 2
[[figure]]
name = "cross"
)";

TEST(FigureGrammar, without_a_rule_every_other_figure_follows_as_often_as_it_was_seen) {
    const auto grammar = parse_grammar(kSeen, "x.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_EQ(grammar->rules[0].after, (std::vector<double>{0.0, 2.0, 1.0}));
    EXPECT_EQ(grammar->rules[1].after, (std::vector<double>{6.0, 0.0, 1.0}));
    EXPECT_EQ(grammar->rules[2].after, (std::vector<double>{6.0, 2.0, 0.0}));
    const auto seen = [](const std::string& value) {
        return parse_grammar(std::string(kSeen).replace(kSeen.find("seen = 6"), 8, value),
                             "x.toml");
    };
    EXPECT_EQ(seen("seen = -1").error().message, "x.toml: line 4: seen must be a number >= 0");
    EXPECT_EQ(seen("seen = 0")->rules[1].after, (std::vector<double>{0.0, 0.0, 1.0}));
}

TEST(FigureGrammar, figures_in_a_fixed_order_come_one_after_the_other) {
    FigureGrammar head;
    head.dance = "mine";
    const std::string chain = grammar_head_text(head) + figure_rule_text("a_1", 1.0, "a_2") +
                              figure_rule_text("a_2", 0.0, "a_3") + figure_rule_text("a_3", 0.0);
    const auto alone = parse_grammar(chain, "x.toml");
    ASSERT_TRUE(alone) << alone.error().message;
    EXPECT_EQ(alone->rules[0].after, (std::vector<double>{0.0, 1.0, 0.0}));
    EXPECT_EQ(alone->rules[1].after, (std::vector<double>{0.0, 0.0, 1.0}));
    EXPECT_EQ(alone->rules[2].after, (std::vector<double>{1.0, 0.0, 0.0}));
    const auto beside = parse_grammar(chain + figure_rule_text("b", 2.0), "x.toml");
    ASSERT_TRUE(beside) << beside.error().message;
    EXPECT_EQ(beside->rules[2].after, (std::vector<double>{1.0, 0.0, 0.0, 2.0}));
    EXPECT_EQ(beside->rules[3].after, (std::vector<double>{1.0, 0.0, 0.0, 0.0}));
    const auto none = parse_grammar(
        grammar_head_text(head) + figure_rule_text("a", 0.0) + figure_rule_text("b", 0.0),
        "x.toml");
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("nothing comes after \"a\""), std::string::npos);
}

TEST(FigureGrammar, the_only_figure_follows_itself) {
    const auto grammar = parse_grammar(
        "format = \"raks-dance\"\nversion = 1\ndance = \"x\"\n[[figure]]\nname = \"a\"\n",
        "x.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    EXPECT_EQ(grammar->rules[0].after, std::vector<double>{1.0});
}

TEST(FigureGrammar, figures_of_another_file_join) {
    const raks::test::TemporaryFolder folder;
    const auto file = folder / "more.toml";
    ASSERT_TRUE(write_file(file, R"(format = "raks-dance"
version = 1
dance = "salsa"
[[figure]]
name = "wave"
seen = 0.5
after = { basic = 2, wave = 1 }
)"));
    auto grammar = parse_grammar(kGood, "x.toml");
    ASSERT_TRUE(grammar) << grammar.error().message;
    const auto joined = extend_grammar(file, *grammar);
    ASSERT_TRUE(joined) << joined.error().message;
    ASSERT_EQ(grammar->rules.size(), 3U);
    // basic goes on to turn with 3 and to itself with 1: to the new one with half of their mean.
    EXPECT_EQ(grammar->rules[0].after, (std::vector<double>{1.0, 3.0, 1.0}));
    EXPECT_EQ(grammar->rules[1].after, (std::vector<double>{1.5, 0.0, 0.75}));
    EXPECT_EQ(grammar->rules[2].after, (std::vector<double>{2.0, 0.0, 1.0}));

    const auto twice = extend_grammar(file, *grammar);
    EXPECT_EQ(twice.error().message, file.string() + ": line 4: figure \"wave\" is there twice");
    EXPECT_EQ(grammar->rules.size(), 3U) << "a bad file changes nothing";
}

TEST(FigureGrammar, its_own_text_reads_back) {
    FigureGrammar grammar;
    grammar.dance = "tango";
    grammar.beats_per_bar = 4;
    grammar.starts = FigureGrammar::Starts::own;
    const std::string text =
        grammar_head_text(grammar) + figure_rule_text("walk", 3.0) + figure_rule_text("ocho", 1.0);
    const auto read = parse_grammar(text, "x.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->starts, FigureGrammar::Starts::own);
    EXPECT_EQ(read->rules[1].after, (std::vector<double>{3.0, 0.0}));
    EXPECT_EQ(*figures_in_grammar(text, "x.toml"), (std::vector<std::string>{"walk", "ocho"}));
}

}  // namespace
}  // namespace raks::motion
