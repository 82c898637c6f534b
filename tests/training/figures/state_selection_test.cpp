#include "training/figures/state_selection.hpp"

#include <gtest/gtest.h>

#include "tests/motion/figures/small_figure.hpp"

namespace raks::motion {
namespace {

/// The known dance, a clip for each take, three figures in each.
struct Takes {
    std::vector<TrainingClip> clips;
    std::vector<FigureRepeat> repeats;
};

Takes known_takes(std::size_t count) {
    Takes takes;
    for (std::size_t i = 0; i < count; ++i) {
        takes.clips.push_back(test::known_dance(3, 0.1 * static_cast<double>(i)));
        takes.clips.back().name = "take_" + std::to_string(i);
        for (FigureRepeat repeat : test::known_repeats(3)) {
            repeat.clip = i;
            takes.repeats.push_back(repeat);
        }
    }
    return takes;
}

FigureTrainingOptions rounds(int iterations) {
    FigureTrainingOptions options = test::known_options();
    options.baum_welch_iterations = iterations;
    return options;
}

TEST(ChooseStates, is_the_fewest_within_a_share_of_the_gain) {
    const struct {
        std::vector<double> held_out;  // of 2, 3, ... states
        int peak;
        int chosen;
    } table[] = {
        {{1.0}, 2, 2},
        {{0.0, 5.0, 9.6, 10.0, 9.0}, 5, 4},  // 9.6 lacks 4 % of the gain
        {{0.0, 5.0, 9.4, 10.0, 9.0}, 5, 5},
        {{3.0, 2.0, 1.0, -50.0}, 2, 2},        // falls from the start
        {{2.0, 1.0, 2.97, 3.0, -50.0}, 5, 4},  // what comes after the peak has no say
        {{7.0, 7.0, 7.0}, 2, 2},               // flat
        {{-3.0, -2.0, -1.0}, 4, 4},            // still rising at the end
    };
    for (const auto& row : table) {
        PartSelection part;
        for (const double value : row.held_out) {
            part.tried.push_back(
                {.states = 2 + static_cast<int>(part.tried.size()), .held_out = value});
        }
        choose_states(part, 0.05);
        EXPECT_EQ(part.peak, row.peak) << ::testing::PrintToString(row.held_out);
        EXPECT_EQ(part.chosen, row.chosen) << ::testing::PrintToString(row.held_out);
    }
}

TEST(SelectStates, leaves_whole_takes_out) {
    const Takes takes = known_takes(5);
    const auto one_by_one = select_states(takes.clips, takes.repeats, rounds(1), {.most = 3});
    ASSERT_TRUE(one_by_one) << one_by_one.error().message;
    ASSERT_EQ(one_by_one->folds.size(), 5U);
    EXPECT_EQ(one_by_one->folds[3], std::vector<std::string>{"take_3"});
    const auto grouped =
        select_states(takes.clips, takes.repeats, rounds(1), {.most = 3, .most_folds = 2});
    ASSERT_TRUE(grouped) << grouped.error().message;
    ASSERT_EQ(grouped->folds.size(), 2U);
    EXPECT_EQ(grouped->folds[0], (std::vector<std::string>{"take_0", "take_2", "take_4"}));
}

TEST(SelectStates, a_leg_that_swings_wants_more_than_two_states) {
    const Takes takes = known_takes(3);
    const auto selection = select_states(takes.clips, takes.repeats, rounds(3), {.most = 8});
    ASSERT_TRUE(selection) << selection.error().message;
    const PartSelection& lower = selection->parts[static_cast<std::size_t>(Part::lower)];
    ASSERT_EQ(lower.tried.size(), 7U);
    EXPECT_EQ(lower.tried.front().states, 2);
    EXPECT_GT(lower.chosen, 4);
    // Unseen takes of a dance without noise are as likely as those learnt from.
    EXPECT_NEAR(lower.tried.back().training, lower.tried.back().held_out, 0.5);
}

TEST(SelectStates, any_number_of_threads_gives_the_same_bits) {
    const Takes takes = known_takes(3);
    const auto one = select_states(takes.clips, takes.repeats, rounds(2), {.most = 5});
    const auto four =
        select_states(takes.clips, takes.repeats, rounds(2), {.most = 5, .threads = 4});
    ASSERT_TRUE(one && four);
    for (std::size_t p = 0; p < kParts.size(); ++p) {
        for (std::size_t n = 0; n < one->parts[p].tried.size(); ++n) {
            EXPECT_EQ(one->parts[p].tried[n].training, four->parts[p].tried[n].training);
            EXPECT_EQ(one->parts[p].tried[n].held_out, four->parts[p].tried[n].held_out);
        }
    }
}

TEST(SelectStates, refuses_what_cannot_be_judged) {
    const auto message = [](const Takes& takes, const StateSelectionOptions& options) {
        const auto selection = select_states(takes.clips, takes.repeats, rounds(1), options);
        return selection ? std::string("selected") : selection.error().message;
    };
    EXPECT_EQ(message(known_takes(1), {.most = 3}),
              "3 repeats of one take only: the number of states is judged by takes left out, so "
              "give at least two");
    Takes single = known_takes(1);
    single.repeats.resize(1);
    EXPECT_EQ(message(single, {.most = 3}),
              "1 repeat of one take only: the number of states is judged by takes left out, so "
              "give at least two");
    EXPECT_EQ(message(known_takes(2), {.fewest = 4, .most = 3}),
              "states from 4 to 3, must rise and lie in [1, 192]");
    EXPECT_EQ(message(known_takes(2), {.most = 193}),
              "states from 2 to 193, must rise and lie in [1, 192]");
    Takes spoilt = known_takes(2);
    spoilt.clips[1].poses[5].hips_position.x = std::nanf("");
    EXPECT_EQ(message(spoilt, {.most = 3}),
              "take_1: frame 5 is not finite or more than 1000 m away; mend or cut the clip");
}

}  // namespace
}  // namespace raks::motion
