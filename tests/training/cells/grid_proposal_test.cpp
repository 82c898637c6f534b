#include "training/cells/grid_proposal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::motion::grid_proposal_test {
namespace {

/// Steps that land on known beats, with arms that swing once a beat; stands before and after.
TrainingClip dancing_clip(double beat, double rate = 60.0) {
    test::SteppingDance dance;
    dance.frames_per_second = rate;
    dance.beat = beat;
    dance.repeats = 6;
    dance.start = 4.0;
    dance.end = 4.0;
    TrainingClip clip = test::stepping_clip(dance);
    const double end = dance.count_1(dance.repeats);
    for (std::size_t frame = 0; frame < clip.poses.size(); ++frame) {
        const double time = static_cast<double>(frame) / rate;
        if (time < dance.start || time > end) {
            continue;
        }
        // They stop on the beat.
        const double swing = 0.7 * std::cos(M_PI * (time - dance.start) / beat);
        for (const Bone bone : {Bone::left_upper_arm, Bone::right_upper_arm}) {
            clip.poses[frame].rotation(bone) =
                clip.poses[frame].rotation(bone) *
                glm::angleAxis(static_cast<float>(swing), glm::vec3(0.0F, 1.0F, 0.0F));
        }
    }
    return clip;
}

TEST(GridProposal, finds_the_tempo_and_the_beats_of_a_dance_whose_steps_are_known) {
    for (const double tempo : {100.0, 125.0, 140.0}) {
        const double beat = 60.0 / tempo;
        const GridCues cues = grid_cues(dancing_clip(beat));
        const GridProposal proposal = propose_grid("steps", cues);
        EXPECT_NEAR(proposal.tempo(), tempo, 0.03 * tempo);
        double within = 0.0;
        double used = 0.0;
        for (const GridBeat& one : proposal.grid.beats) {
            const double beats = (one.time - 4.0) / beat;
            used += one.is_used ? 1.0 : 0.0;
            within += one.is_used && std::abs(beats - std::round(beats)) < 0.2 ? 1.0 : 0.0;
        }
        EXPECT_GT(used, 40.0) << tempo;
        EXPECT_GT(within, 0.9 * used) << tempo;
    }
}

TEST(GridProposal, finds_a_planted_loop) {
    const double beat = 0.45;
    const GridProposal proposal = propose_grid("steps", grid_cues(dancing_clip(beat)));
    ASSERT_FALSE(proposal.lags.empty());
    const bool has_loop =
        std::any_of(proposal.lags.begin(), proposal.lags.end(), [beat](const FoundLag& lag) {
            return std::abs(lag.seconds - 8.0 * beat) < 0.06 && lag.distance < 0.2;
        });
    EXPECT_TRUE(has_loop);
}

TEST(GridProposal, does_not_use_idle_ends_and_alternates_halves) {
    const GridProposal proposal = propose_grid("steps", grid_cues(dancing_clip(0.5)));
    EXPECT_NEAR(proposal.idle_seconds, 8.0, 1.5);
    for (std::size_t i = 0; i < proposal.grid.beats.size(); ++i) {
        const GridBeat& beat = proposal.grid.beats[i];
        EXPECT_TRUE(!beat.is_used || (beat.time > 3.0 && beat.time < 29.0)) << beat.time;
        if (i > 0) {
            EXPECT_NE(beat.half, proposal.grid.beats[i - 1].half);
            EXPECT_GT(beat.time, proposal.grid.beats[i - 1].time);
        }
    }
}

TEST(GridProposal, is_the_same_for_a_clip_of_another_rate) {
    const double tempo = propose_grid("steps", grid_cues(dancing_clip(0.5))).tempo();
    for (const double rate : {15.0, 30.0, 240.0}) {
        const GridProposal proposal = propose_grid("steps", grid_cues(dancing_clip(0.5, rate)));
        EXPECT_NEAR(proposal.tempo(), tempo, 0.03 * tempo) << rate;
    }
}

TEST(GridProposal, has_no_beats_of_who_stands_and_of_a_moment) {
    test::SteppingDance still;
    still.repeats = 0;
    still.start = 20.0;
    const GridProposal none = propose_grid("still", grid_cues(test::stepping_clip(still)));
    EXPECT_TRUE(none.grid.beats.empty());
    EXPECT_NEAR(none.idle_seconds, 21.0, 0.1);
    EXPECT_EQ(none.tempo(), 0.0);
    TrainingClip one = test::stepping_clip(still);
    one.poses.resize(1);
    one.feet.resize(1);
    EXPECT_TRUE(propose_grid("one", grid_cues(one)).grid.beats.empty());
}

}  // namespace
}  // namespace raks::motion::grid_proposal_test
