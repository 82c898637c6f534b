// The choreography file: what a dancer writes is read as meant, and every fault is told in one line
// with its place.
#include "motion/choreography/authored_dance.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/motion/choreography/small_dance.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

AuthoredDance small_dance() {
    auto dance = parse_authored_dance(kSmallDance, "rock.toml");
    EXPECT_TRUE(dance) << dance.error().message;
    return dance ? *dance : AuthoredDance{};
}

TEST(AuthoredDance, is_read_as_it_is_written) {
    const AuthoredDance dance = small_dance();
    EXPECT_EQ(dance.dance, "rock");
    EXPECT_EQ(dance.written.bpm(), 120.0);
    EXPECT_EQ(dance.beats_per_bar, 4);
    ASSERT_EQ(dance.figures.size(), 2U);
    const AuthoredFigure& figure = dance.figures[0];
    EXPECT_EQ(figure.name, "rock_step");
    EXPECT_EQ(figure.beats, 4);
    EXPECT_EQ(figure.line, 22U);
    ASSERT_EQ(figure.steps.size(), 2U);
    EXPECT_EQ(figure.steps[0].on, FootLanding::heel);
    EXPECT_EQ(figure.steps[0].air, 0.6);
    EXPECT_EQ(figure.steps[1].foot, Side::right);
    EXPECT_EQ(figure.steps[1].weight, 0.2);
    EXPECT_EQ(figure.steps[1].to, glm::dvec2(-16, 0));
    ASSERT_EQ(figure.tracks(Control::chest_yaw).size(), 1U);
    EXPECT_EQ(figure.tracks(Control::chest_yaw)[0].snap, 0.3);
    const AuthoredFigure& sway = dance.figures[1];
    EXPECT_TRUE(sway.is_mirrored);
    EXPECT_FALSE(sway.steps[0].to);
    EXPECT_FALSE(sway.steps[0].weight);
    EXPECT_EQ(sway.expectation.jerk->rms, 400.0);
    EXPECT_EQ(sway.expectation.hip_travel->highest, 60.0);
}

TEST(AuthoredDance, a_figure_comes_before_the_file_and_one_side_before_both) {
    const AuthoredDance dance = small_dance();
    const AuthoredFigure& figure = dance.figures[0];
    // The figure's both sides before the file's left.
    EXPECT_EQ(figure.tracks(Control::left_arm_front).size(), 2U);
    EXPECT_EQ(figure.tracks(Control::right_arm_front)[1].lag, 0.0);
    const AuthoredFigure& sway = dance.figures[1];
    EXPECT_EQ(sway.tracks(Control::left_arm_front)[0].rest, 45.0);
    EXPECT_EQ(sway.tracks(Control::right_arm_front)[0].rest, 35.0);  // where nothing is written
    EXPECT_EQ(sway.tracks(Control::right_hand_fist)[0].rest, 0.6);
    EXPECT_EQ(sway.tracks(Control::knee)[0].rest, 30.0);
    EXPECT_EQ(figure.tracks(Control::knee)[0].rest, 24.0);
    EXPECT_EQ(sway.style.iso, 0.4);
}

TEST(AuthoredDance, the_shipped_ones_are_read) {
    const fs::path folder = fs::path(RAKS_SOURCE_DIR) / "config" / "choreographies";
    std::size_t figures = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const auto dance = load_authored_dance(entry.path());
        ASSERT_TRUE(dance) << dance.error().message;
        EXPECT_EQ(dance->dance, entry.path().stem());
        figures += dance->figures.size();
    }
    EXPECT_GE(figures, 28U);
}

TEST(AuthoredDance, tells_what_is_wrong_and_where) {
    const struct {
        std::string text;
        const char* expected;
    } cases[] = {
        {"", "rock.toml: format must be \"raks-choreography\""},
        {"[[", "rock.toml: line 1, column 3: "},
        {replaced("[[figure]]", " [[[figure]]]"), "line 21, column 4: '[' cannot stand here"},
        {replaced("[style]", "[+style]"), "line 8, column 2: '+' cannot stand here"},
        {replaced("[[figure]]", "[figure]"), "line 30, column 1: "},
        {replaced("version = 1", "version = 2"), "is Raks older than the file?"},
        {replaced("dance = \"rock\"", ""), "needs dance"},
        {replaced("tempo = [90, 120, 150]", ""), "needs tempo"},
        {replaced("[90, 120, 150]", "[150, 120, 90]"), "line 4: tempo must rise"},
        {replaced("[90, 120, 150]", "[90, 150]"), "line 4: tempo must be three numbers"},
        {replaced("beats_per_bar = 4", "beats_per_bar = 3.5"), "must be a whole number"},
        {replaced("licence", "lisence"), "line 6: key \"lisence\" is unknown; did you mean"},
        {replaced("iso = 0.4", "isso = 0.4"), "line 10: key \"isso\" is unknown; did you mean"},
        {replaced("iso = 0.4", "iso = 2"), "line 10: iso is 2, must be 0 to 1"},
        {replaced("hip.y", "hip.yy"), "line 13: control \"hip.yy\" is unknown; did you mean"},
        {replaced("arms.up = -60", "elbows.up = -60"), "line 14: control \"elbows.up\" is unknown"},
        {replaced("arms.up = -60", "arms.up = \"down\""), "line 14: arms.up must be a number"},
        {replaced("arms.up = -60", "arms.up = nan"), "line 14: arms.up is nan"},
        {replaced("arms.up = -60", "arms.up = inf"), "line 14: arms.up is inf"},
        {replaced("wave = 2,", "wavy = 2,"), "line 13: key \"wavy\" is unknown; did you mean"},
        {replaced("every = 1, peak = 0.5", "every = 0, peak = 0.5"),
         "line 13: every is 0, must be"},
        {replaced("[1, 60]", "[60, 1]"), "line 19: hip_travel must rise"},
        {replaced("name = \"sway\"", "name = \"rock_step\""),
         "line 31: figure \"rock_step\" is there twice, first in line 22"},
        {replaced("name = \"sway\"", "name = \"Sw/ay\""), "a figure needs a name of a-z"},
        {replaced("beats = 4\n", "beats = 0\n"),
         "figure \"rock_step\": beats is 0, must be 1 to 64"},
        {replaced("beats = 4\n", "beats = 1000\n"), "line 23: figure \"rock_step\": beats is 1000"},
        {replaced("beats = 4\n", ""), "figure \"rock_step\": needs beats"},
        {replaced("mirror = true", "mirror = 1"), "mirror must be true or false"},
        {replaced("foot = \"l\"", "foot = \"left\""),
         "line 25: figure \"rock_step\": a step needs"},
        {replaced("at = 2, ", ""), "line 26: figure \"rock_step\": a step needs at"},
        {replaced("at = 2, ", "at = 9, "),
         "line 26: figure \"rock_step\": at is 9, must be -1 to 4"},
        {replaced("to = [16, 6]", "to = [16]"), "to must be [left, forward] cm"},
        {replaced("to = [16, 6]", "too = [16, 6]"), "did you mean \"to\""},
        {replaced("on = \"heel\"", "on = \"heal\""), "did you mean \"heel\""},
        {replaced("weight = 0.2", "weight = 1.2"), "weight is 1.2"},
        {replaced("weight = 0.2", "weight = -0.2"), "or -1 for no change"},
        {replaced("to = [-16, 0]", "to = [15, 5]"), "beat 2: right foot lands on the left foot"},
        {replaced("foot = \"r\", at = 2", "foot = \"l\", at = 0.1"),
         "line 26: figure \"rock_step\": beat 0.1: left foot leaves the floor at -0.4"},
        {replaced("foot = \"r\", at = 2", "foot = \"l\", at = 3.9"),
         "beat 4: left foot leaves the floor at 3.4 and only lands"},
        {replaced("[[0, 8], [2, -8]]", "[[2, 8], [0, -8]]"),
         "line 27: figure \"rock_step\": beat 0: keys of chest.yaw must rise"},
        {replaced("[[0, 8], [2, -8]]", "[[0, 8], [5, -8]]"), "beat 5: a key of chest.yaw lies"},
        {replaced("[[0, 8], [2, -8]]", "[]"), "keys of chest.yaw must be"},
        {replaced("[[0, 8], [2, -8]]", "[[0, 8], [2, -80]]"),
         "figure \"rock_step\": beat 2: chest.yaw comes to -88.8 degrees, must stay within -60 to"},
        {replaced("[ 50, {", "[ 135, {"), "arm.l.front comes to 143 degrees"},
        {replaced("expect.jerk", "expect.jelk"), "did you mean \"jerk\""}};
    for (const auto& c : cases) {
        const auto dance = parse_authored_dance(c.text, "rock.toml");
        ASSERT_FALSE(dance) << c.expected;
        const std::string& message = dance.error().message;
        EXPECT_NE(message.find(c.expected), std::string::npos) << message << "\n  " << c.expected;
        EXPECT_EQ(message.find("rock.toml"), 0U) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(AuthoredDance, survives_every_cut_and_flipped_bytes) {
    const auto is_one_line = [](const Expected<AuthoredDance>& dance) {
        return dance || dance.error().message.find('\n') == std::string::npos;
    };
    for (std::size_t length = 0; length < kSmallDance.size(); ++length) {
        EXPECT_TRUE(is_one_line(parse_authored_dance(kSmallDance.substr(0, length), "x.toml")));
    }
    constexpr std::uint64_t kFlips = 2000;
    for (std::uint64_t seed = 0; seed < kFlips; ++seed) {
        const std::string text =
            raks::test::mangled(kSmallDance, {.seed = seed, .bytes = 1 + seed % 3});
        EXPECT_TRUE(is_one_line(parse_authored_dance(text, "x.toml"))) << seed;
    }
}

TEST(AuthoredDance, a_missing_or_huge_file_is_one_line) {
    EXPECT_FALSE(load_authored_dance("no_such.toml"));
    const raks::test::TemporaryFolder folder;
    const fs::path path = folder / "huge.toml";
    ASSERT_TRUE(write_file(path, std::string(2U << 20U, '#')));
    EXPECT_FALSE(load_authored_dance(path));
}

TEST(AuthoredDance, names_every_hop) {
    auto dance = parse_authored_dance(
        replaced("foot = \"r\", at = 2", "foot = \"r\", at = 0.2, air = 0.5"), "x.toml");
    ASSERT_TRUE(dance) << dance.error().message;
    const std::vector<Hop> hops = hops_of(dance->figures[0]);
    ASSERT_EQ(hops.size(), 1U);  // the right foot leaves at 3.7 of the repeat, the left lands at 4
    EXPECT_NEAR(hops[0].from, 3.7, 1e-9);
    EXPECT_NEAR(hops[0].to, 4.0, 1e-9);
    EXPECT_TRUE(hops_of(small_dance().figures[0]).empty());
}

TEST(Controls, mirror_to_their_own_kind_and_are_found_by_both_names) {
    for (std::size_t i = 0; i < kControlCount; ++i) {
        const auto control = static_cast<Control>(i);
        EXPECT_EQ(mirrored(mirrored(control)), control);
        EXPECT_EQ(info_of(control).group, info_of(mirrored(control)).group);
        EXPECT_EQ(controls_named(info_of(control).name).count, 1U);
        EXPECT_LE(info_of(control).lowest, info_of(control).rest);
        EXPECT_GE(info_of(control).highest, info_of(control).rest);
    }
    EXPECT_EQ(controls_named("hands.turn").count, 2U);
    EXPECT_EQ(controls_named("hands").count, 0U);
}

}  // namespace
}  // namespace raks::motion
