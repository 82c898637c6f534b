#include "training/cells/cell_training.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "motion/cells/cell_file.hpp"
#include "tests/training/cells/made_take.hpp"

namespace raks::motion {
namespace {

using test::MadeTake;

/// Sixteen beats of four keys: they hang together.
MadeTake usual_take() {
    MadeTake take;
    take.keys = test::random_keys(16, 4, 1);
    return take;
}

CellTrainingPlan plan_of(const std::vector<MadeTake>& takes) {
    CellTrainingPlan plan;
    plan.dance = "made";
    for (const MadeTake& take : takes) {
        const auto beats = made_beats(take);
        plan.beats.insert(plan.beats.end(), beats.begin(), beats.end());
    }
    return plan;
}

Expected<CellTrainingReport> learnt(const std::vector<MadeTake>& takes,
                                    const CellTrainingPlan& plan) {
    std::vector<TrainingClip> clips;
    for (const MadeTake& take : takes) {
        clips.push_back(made_clip(take));
    }
    return train_cells(plan, clips);
}

Expected<CellTrainingReport> learnt(const std::vector<MadeTake>& takes) {
    return learnt(takes, plan_of(takes));
}

/// The line that says why nothing is learnt.
std::string refusal(const std::vector<MadeTake>& takes) {
    const auto report = learnt(takes);
    return report ? "it is learnt" : report.error().message;
}

TEST(CellTraining, cells_are_the_beats_of_the_table) {
    const auto report = learnt({usual_take()});
    ASSERT_TRUE(report) << report.error().message;
    const CellGraph& graph = report->dance.graph;
    EXPECT_EQ(graph.cells.size(), 15U);
    EXPECT_NEAR(graph.beat_seconds, 0.5, 1e-9);
    EXPECT_EQ(report->takes[0].count(BeatFate::danced), 15U);
    EXPECT_EQ(report->takes[0].labelled(), 16U);
    EXPECT_TRUE(report->has_rests);
    EXPECT_TRUE(report->has_endings);
    EXPECT_GT(report->people_jerk_rms, 1.0);
    EXPECT_GT(report->people_jerk_p999, report->people_jerk_rms);
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        EXPECT_EQ(graph.cells[i].beat, i + 1);
        EXPECT_EQ(graph.cells[i].is_second_half, i % 2 == 1);
        // Each beat ends in a key pose, with both feet on the floor.
        EXPECT_TRUE(is_rest(graph, i)) << i;
        EXPECT_EQ(graph.cells[i].landings[0], Cell::kNoLanding);
    }
}

TEST(CellTraining, a_landing_is_kept_as_far_from_its_beat_as_it_is) {
    MadeTake take = usual_take();
    take.is_stepping = true;
    for (const double late : {-0.1, 0.0, 0.2}) {
        take.steps_late = late;
        const auto report = learnt({take});
        ASSERT_TRUE(report) << report.error().message;
        double sum = 0.0;
        for (const Cell& cell : report->dance.graph.cells) {
            ASSERT_NE(cell.landings[0], Cell::kNoLanding);
            EXPECT_EQ(cell.landings[1], Cell::kNoLanding);
            sum += static_cast<double>(cell.landings[0]);
        }
        // The foot is under 0.3 m/s a little before it stops.
        const auto cells = static_cast<double>(report->dance.graph.cells.size());
        EXPECT_NEAR(sum / cells, late - 0.04, 0.05);
        EXPECT_EQ(report->far_landings, late > 0.15 ? report->landings : 0U);
    }
}

TEST(CellTraining, gives_the_same_bits_on_any_number_of_threads) {
    std::vector<MadeTake> takes(3, usual_take());
    for (std::size_t i = 0; i < takes.size(); ++i) {
        takes[i].name = "take" + std::to_string(i);
        takes[i].unlike = 0.05;
        takes[i].keys = test::random_keys(12, 4, i);
    }
    CellTrainingPlan plan = plan_of(takes);
    const auto one = learnt(takes, plan);
    ASSERT_TRUE(one) << one.error().message;
    plan.threads = 4;
    EXPECT_EQ(cell_text(one->dance), cell_text(learnt(takes, plan)->dance));
}

TEST(CellTraining, a_take_that_is_left_out_changes_nothing) {
    std::vector<MadeTake> takes(2, usual_take());
    takes[1].name = "other";
    takes[1].keys = test::random_keys(12, 4, 9);
    CellTrainingPlan plan = plan_of(takes);
    plan.without = {"other"};
    const auto without = learnt(takes, plan);
    ASSERT_TRUE(without) << without.error().message;
    EXPECT_EQ(without->takes.size(), 1U);
    EXPECT_EQ(cell_text(without->dance), cell_text(learnt({takes[0]})->dance));
    plan.without = {"nobody"};
    EXPECT_EQ(learnt(takes, plan).error().message,
              "nobody: cannot be left out, the table has no such take");
}

TEST(CellTraining, takes_of_two_bodies_go_over_into_each_other) {
    std::vector<MadeTake> takes(2, usual_take());
    takes[1].name = "child";
    takes[1].size = 0.7;
    const auto report = learnt(takes);
    ASSERT_TRUE(report) << report.error().message;
    const CellGraph& graph = report->dance.graph;
    EXPECT_EQ(graph.cells.size(), 30U);
    EXPECT_EQ(report->tied_cells, 30U);  // the same dance, twice at least
    bool is_joined = false;
    for (std::size_t cell = 0; cell < graph.cells.size(); ++cell) {
        for (const CellArc& arc : graph.arcs_of(cell)) {
            is_joined = is_joined ||
                        (graph.cells[cell].take != graph.cells[arc.to].take && arc.distance < 2.0F);
        }
    }
    EXPECT_TRUE(is_joined);
    EXPECT_NEAR(
        report->dance.takes[1].source_hips_height / report->dance.takes[0].source_hips_height,
        0.7,
        1e-6);
}

TEST(CellTraining, clips_of_15_and_240_frames_a_second_make_the_same_cells) {
    for (const double rate : {15.0, 240.0}) {
        MadeTake take = usual_take();
        take.frames_per_second = rate;
        const auto report = learnt({take});
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(report->dance.graph.cells.size(), 15U) << rate;
        EXPECT_EQ(report->people_jerk_rms > 0.0, rate > 50.0);
    }
    MadeTake slow = usual_take();
    slow.frames_per_second = 8.0;
    EXPECT_EQ(refusal({slow}), "made: has 8 frames a second, must be 14 to 1000");
}

TEST(CellTraining, a_walk_is_danced_and_goes_ahead) {
    MadeTake walk = usual_take();
    walk.way = 1.2;
    const auto report = learnt({walk});
    ASSERT_TRUE(report) << report.error().message;
    for (const Cell& cell : report->dance.graph.cells) {
        EXPECT_NEAR(cell.way.y, 0.6F, 0.02F);
    }
}

TEST(CellTraining, a_leap_costs_the_beat_in_which_it_is) {
    const MadeTake take = usual_take();
    TrainingClip clip = made_clip(take);
    for (std::size_t f = 200; f < clip.poses.size(); ++f) {
        clip.poses[f].hips_position.x += 2.0F;
    }
    const auto report = train_cells(plan_of({take}), std::span(&clip, 1));
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->takes[0].count(BeatFate::leap), 1U);
    for (const Cell& cell : report->dance.graph.cells) {
        EXPECT_LT(std::abs(cell.way.x), 0.5F);
    }
}

TEST(CellTraining, a_minute_in_a_T_pose_is_no_dance) {
    MadeTake take;
    take.keys = test::random_keys(120, 6, 1);
    TrainingClip clip = made_clip(take);
    for (Pose& pose : clip.poses) {
        pose.local_rotations = Pose().local_rotations;
        pose.hips_position.y = mannequin_skeleton().hips_height();
    }
    const auto report = train_cells(plan_of({take}), std::span(&clip, 1));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message,
              "no beat of the takes can be danced (1 not used, 119 with arms held spread); a beat "
              "lasts 0.32 to 0.9 s: of slower music label the half beats, of faster music every "
              "other one");
}

TEST(CellTraining, beats_of_60_and_200_a_minute_are_refused_with_advice) {
    for (const double beat : {1.0, 0.3}) {
        MadeTake take = usual_take();
        take.beat = beat;
        EXPECT_EQ(refusal({take}),
                  "no beat of the takes can be danced (1 not used, 15 too short or too long); a "
                  "beat lasts 0.32 to 0.9 s: of slower music label the half beats, of faster music "
                  "every other one");
    }
}

TEST(CellTraining, beats_beyond_the_clip_are_refused_with_their_line) {
    const MadeTake take = usual_take();
    TrainingClip clip = made_clip(take);
    clip.poses.resize(300);
    clip.feet.resize(300);
    const auto report = train_cells(plan_of({take}), std::span(&clip, 1));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message,
              "made: the beat at 5.100 s (the table's line 11) lies beyond the end of the clip, "
              "4.983 s; take it out or set \"used\" of the beat before to 0");
}

TEST(CellTraining, takes_too_short_for_a_dance_are_refused) {
    MadeTake take = usual_take();
    take.keys.resize(2);
    EXPECT_EQ(
        refusal({take}),
        "of 1 beats that can be danced none leads back to another; label more, or more takes");
    take.keys.resize(4);  // three seconds
    const auto report = learnt({take});
    EXPECT_TRUE(report || report.error().message.find("none leads back") != std::string::npos);
    MadeTake moment = usual_take();
    moment.keys.resize(2);
    moment.start = 0.1;
    EXPECT_EQ(refusal({moment}), "made: lasts 0.72 s, must be 1 s at least");
}

TEST(CellTraining, more_beats_than_a_dance_holds_are_refused_before_a_clip_is_read) {
    CellTrainingPlan plan;
    plan.dance = "made";
    TrainingClip clip;
    clip.name = "long";
    for (std::size_t i = 0; i < 10'000; ++i) {
        plan.beats.push_back({"long", 0.5 * static_cast<double>(i), 1, true, i + 2});
    }
    const auto report = train_cells(plan, std::span(&clip, 1));
    ASSERT_FALSE(report);
    EXPECT_EQ(
        report.error().message,
        "the table has 10000 beats to be danced, a dance holds 2048 at most; leave takes out, "
        "or set their column \"used\" to 0");
}

}  // namespace
}  // namespace raks::motion
