// Which figure comes next, and how the figures of a dance fit together.
#include "motion/dance/figure_chooser.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "motion/dance/dance_content.hpp"
#include "motion/dance/figure_sequence.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

FigureGrammar three() {
    FigureGrammar grammar;
    grammar.rules = {{.figure = "calm", .energy = 0.1, .after = {0.0, 3.0, 1.0}, .holds = {}},
                     {.figure = "middling", .energy = 0.5, .after = {1.0, 0.0, 1.0}, .holds = {}},
                     {.figure = "lively", .energy = 0.9, .after = {1.0, 1.0, 2.0}, .holds = {}}};
    return grammar;
}

const std::vector<bool> kLastTurnsHalf = {false, false, true};

/// How often each figure comes then, of 4,000.
std::array<int, 3> followers(const FigureMoment& moment,
                             const FigureWish& wish = {},
                             const FigureGrammar& grammar = three()) {
    const FigureChooser choreography(grammar, kLastTurnsHalf);
    std::array<int, 3> counts{};
    for (std::uint64_t number = 0; number < 4000; ++number) {
        ++counts[choreography.next(moment, wish, 11, number)];
    }
    return counts;
}

TEST(FigureChooser, follows_the_weights_of_the_grammar) {
    // 0.5 lies between: both followers are 0.4 away, so that the weights alone tell.
    FigureGrammar grammar = three();
    grammar.rules[1].energy = 0.1;
    grammar.rules[2].energy = 0.9;
    const std::array<int, 3> counts = followers({.after = 0}, {}, grammar);
    EXPECT_EQ(counts[0], 0) << "the grammar has no repeat here";
    EXPECT_NEAR(counts[1], 3000, 150);
}

TEST(FigureChooser, lively_music_is_danced_livelier) {
    const std::array<int, 3> quiet = followers({.after = 1, .energy = 0.05});
    const std::array<int, 3> loud = followers({.after = 1, .energy = 0.95});
    EXPECT_GT(quiet[0], 2 * quiet[2]);
    EXPECT_GT(loud[2], 2 * loud[0]);
}

TEST(FigureChooser, does_what_is_wished) {
    FigureWish wish;
    wish.is_locked = true;
    EXPECT_EQ(followers({.after = 2}, wish)[2], 4000);
    wish.figure = 1;
    EXPECT_EQ(followers({.after = 2}, wish)[1], 4000);
    FigureWish another;
    another.is_another = true;
    EXPECT_EQ(followers({.after = 2}, another)[2], 0);
}

TEST(FigureChooser, the_same_seed_gives_the_same_dance_another_another) {
    const FigureChooser choreography(three(), kLastTurnsHalf);
    const FigureMoment moment{.after = 1};
    int same = 0;
    for (std::uint64_t number = 0; number < 200; ++number) {
        const std::size_t figure = choreography.next(moment, {}, 3, number);
        EXPECT_EQ(figure, choreography.next(moment, {}, 3, number));
        same += figure == choreography.next(moment, {}, 4, number) ? 1 : 0;
    }
    EXPECT_LT(same, 150);
}

TEST(FigureChooser, turns_to_the_audience_when_it_can_and_away_from_it_more_seldom) {
    const auto of_three = [](Audience audience) {
        return followers({.after = 1, .energy = 0.5, .audience = audience});
    };
    const std::array<int, 3> for_the_other = of_three(Audience::none);
    EXPECT_NEAR(for_the_other[2], 2000, 120) << "of a couple: as the grammar says";
    EXPECT_GT(of_three(Audience::behind)[2], 3500);
    EXPECT_GT(of_three(Audience::behind)[0], 20) << "seldom anything else";
    EXPECT_LT(of_three(Audience::ahead)[2], 1300);
    EXPECT_GT(of_three(Audience::ahead)[2], 500);
}

const DanceContent& salsa() {
    static const DanceContent content = [] {
        auto made = make_content(test::salsa_figures(), mannequin_skeleton(), nullptr);
        EXPECT_TRUE(made) << made.error().message;
        return std::move(*made);
    }();
    return content;
}

TEST(FigureSequence, two_half_turns_lead_back) {
    for (const LibraryFigure& figure : salsa().figures) {
        const FloorMove twice = figure.move * figure.move;
        EXPECT_NEAR(std::remainder(twice.heading, 2.0 * M_PI), 0.0, 1e-9) << figure.name;
        EXPECT_NEAR(glm::length(twice.offset), 0.0, 1e-9) << figure.name;
    }
}

TEST(FigureSequence, all_figures_begin_and_end_on_the_same_feet) {
    // The foot that bears at the change rests at one place in every figure and passage.
    constexpr double kBefore = -0.4;
    const Skeleton skeleton = mannequin_skeleton();
    const auto ball_at = [&](const FigurePassage& passage, double beat) {
        Pose pose;
        passage.at(beat, pose);
        return foot_point(world_pose(skeleton, pose), Side::right, skeleton.ball);
    };
    const glm::vec3 common = ball_at(salsa().figures[0].passages[0], kBefore);
    for (const LibraryFigure& figure : salsa().figures) {
        for (const FigurePassage& passage : figure.passages) {
            const glm::vec3 start = ball_at(passage, kBefore);
            EXPECT_LT(glm::distance(start, common), 0.02F) << figure.name;
            const glm::vec3 end = ball_at(passage, figure.beats + kBefore);
            const glm::dvec2 expected = figure.move(glm::dvec2(common.x, common.z));
            EXPECT_NEAR(end.x, expected.x, 0.02) << figure.name;
            EXPECT_NEAR(end.z, expected.y, 0.02) << figure.name;
        }
    }
}

TEST(FigureSequence, repeats_are_danced_in_different_ways) {
    std::set<std::array<std::size_t, 3>> ways;
    for (std::uint64_t number = 0; number < 100; ++number) {
        const FigureChoice choice = choose_ways(0, 5, number);
        EXPECT_NE(choice.arms[0], choice.arms[1]);
        ways.insert({choice.body, choice.arms[0], choice.arms[1]});
    }
    EXPECT_GT(ways.size(), 80U) << "and the mix of both arms is a number of its own";
}

/// The share of five minutes at 180 BPM in which the hips face less than 60 degrees from the front.
double share_in_front(const DanceContent& content, const DancerPart& part) {
    constexpr double kBeats = 900.0;
    constexpr double kLook = 0.25;
    FigureSequence sequence;
    FigureWish wish;
    sequence.start(content, content.stage, part, false);
    double in_front = 0.0;
    for (double beat = 0.0; beat < kBeats; beat += kLook) {
        sequence.advance(Beats(beat), 0.5, wish);
        const double heading = floor_frame(sequence.at(Beats(beat))).heading;
        in_front += std::cos(heading) > 0.5 ? kLook / kBeats : 0.0;
    }
    return in_front;
}

TEST(FigureSequence, one_alone_faces_the_audience_most_of_the_time) {
    auto content =
        make_content(test::salsa_figures(), mannequin_skeleton(), &test::salsa_grammar());
    ASSERT_TRUE(content) << content.error().message;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        EXPECT_GT(share_in_front(*content, {.seed = seed, .ways = seed}), 0.6) << seed;
    }
}

}  // namespace
}  // namespace raks::motion
