#include "training/discovery/proposal_check.hpp"

#include <gtest/gtest.h>

namespace raks::motion::proposal_check_test {
namespace {

FigureLabel label(std::size_t start, std::size_t end, const std::string& figure) {
    FigureLabel label;
    label.take = "1";
    label.start = start;
    label.end = end;
    label.figure = figure;
    return label;
}

TEST(ProposalCheck, counts_borders_within_half_a_beat_and_periods_within_4_percent) {
    DiscoveredClips found;
    found.clips.resize(2);
    found.clips[0].take = "1";
    found.clips[0].found.beats = 8;
    found.clips[0].found.seconds = 2.7;
    // Half a beat of these labels is 10 frames.
    found.clips[0].found.repeats = {{100, 260}, {269, 425}, {440, 600}};
    found.clips[1].take = "2";
    const std::vector<FigureLabel> labels = {label(109, 269, "basic"),
                                             label(269, 429, "turn"),
                                             label(429, 589, "basic"),
                                             label(589, 700, "idle")};
    FigureTrainingPlan plan;
    const auto checks = check_proposal(found, labels, plan);
    ASSERT_EQ(checks.size(), 2U);
    EXPECT_TRUE(checks[0].is_period_right);
    EXPECT_EQ(checks[0].labelled, 2);
    EXPECT_EQ(checks[0].hit, 1);
    EXPECT_EQ(checks[0].all_labelled, 3);
    EXPECT_EQ(checks[0].all_hit, 2);
    EXPECT_TRUE(checks[1].true_seconds.empty());
    found.clips[0].found.seconds = 2.8;
    EXPECT_FALSE(check_proposal(found, labels, plan)[0].is_period_right);
}

}  // namespace
}  // namespace raks::motion::proposal_check_test
