// Which figure comes next, and how the figures of a dance fit together.
#include "motion/dance/choreography.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "motion/dance/dance_content.hpp"
#include "motion/dance/figure_sequence.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

FigureGrammar three() {
    FigureGrammar grammar;
    grammar.rules = {{"calm", 0.1, {0.0, 3.0, 1.0}},
                     {"middling", 0.5, {1.0, 0.0, 1.0}},
                     {"lively", 0.9, {1.0, 1.0, 2.0}}};
    return grammar;
}

/// How often each figure comes after `current`, of 4,000.
std::array<int, 3> followers(std::size_t current, double energy, const FigureWish& wish = {}) {
    const Choreography choreography(three());
    std::array<int, 3> counts{};
    for (std::uint64_t number = 0; number < 4000; ++number) {
        ++counts[choreography.next(current, energy, wish, 11, number)];
    }
    return counts;
}

TEST(Choreography, follows_the_weights_of_the_grammar) {
    // 0.5 lies between: both followers are 0.4 away, so that the weights alone tell.
    FigureGrammar grammar = three();
    grammar.rules[1].energy = 0.1;
    grammar.rules[2].energy = 0.9;
    const Choreography choreography(grammar);
    std::array<int, 3> counts{};
    for (std::uint64_t number = 0; number < 4000; ++number) {
        ++counts[choreography.next(0, 0.5, {}, 11, number)];
    }
    EXPECT_EQ(counts[0], 0) << "the grammar has no repeat here";
    EXPECT_NEAR(counts[1], 3000, 150);
}

TEST(Choreography, lively_music_is_danced_livelier) {
    EXPECT_GT(followers(1, 0.05)[0], 2 * followers(1, 0.05)[2]);
    EXPECT_GT(followers(1, 0.95)[2], 2 * followers(1, 0.95)[0]);
}

TEST(Choreography, does_what_is_wished) {
    FigureWish wish;
    wish.is_locked = true;
    EXPECT_EQ(followers(2, 0.5, wish)[2], 4000);
    wish.figure = 1;
    EXPECT_EQ(followers(2, 0.5, wish)[1], 4000);
    FigureWish another;
    another.is_another = true;
    EXPECT_EQ(followers(2, 0.5, another)[2], 0);
}

TEST(Choreography, the_same_seed_gives_the_same_dance_another_another) {
    const Choreography choreography(three());
    int same = 0;
    for (std::uint64_t number = 0; number < 200; ++number) {
        EXPECT_EQ(choreography.next(1, 0.5, {}, 3, number),
                  choreography.next(1, 0.5, {}, 3, number));
        same += choreography.next(1, 0.5, {}, 3, number) == choreography.next(1, 0.5, {}, 4, number)
                    ? 1
                    : 0;
    }
    EXPECT_LT(same, 150);
}

TEST(MusicEnergy, is_of_the_last_bars_beside_the_last_half_minute) {
    MusicEnergy energy;
    MusicState music = test::sure_state(0, test::steady_grid(120.0));
    const auto play = [&](float lufs, int hops) {
        music.loudness_lufs = lufs;
        for (int i = 0; i < hops; ++i) {
            energy.advance(music);
        }
        return energy.value();
    };
    EXPECT_NEAR(play(-20.0F, 3000), 0.5, 0.01);
    EXPECT_GT(play(-12.0F, 400), 0.85);
    EXPECT_LT(play(-26.0F, 500), 0.25);
    music.is_silent = true;
    const double before = energy.value();
    EXPECT_EQ(play(-100.0F, 500), before) << "silence says nothing";
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

}  // namespace
}  // namespace raks::motion
