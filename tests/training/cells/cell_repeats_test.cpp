#include "training/cells/cell_repeats.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "motion/dance/baking/trajectory.hpp"
#include "tests/training/cells/made_take.hpp"
#include "training/cells/cell_cutting.hpp"
#include "training/cells/cell_training.hpp"

namespace raks::motion {
namespace {

using test::MadeTake;

constexpr std::size_t kFirst = 4;    // beat of the loop that is planted
constexpr std::size_t kSecond = 18;  // and of its repeat
constexpr std::size_t kLoop = 8;     // beats

/// Forty-two beats of five hundred keys, of which eight beats come twice, or the second time
/// mirrored.
MadeTake with_loop(bool is_mirrored) {
    MadeTake take;
    take.keys = test::random_keys(42, 500, 3);
    for (std::size_t i = 0; i <= kLoop; ++i) {
        take.keys[kSecond + i] = is_mirrored ? ~take.keys[kFirst + i] : take.keys[kFirst + i];
    }
    return take;
}

std::vector<CellSource> cells_of(const MadeTake& take) {
    return cut_take(*prepare_take(made_clip(take)), made_beats(take))->cells;
}

std::string text_of(const std::vector<CellRepeats>& groups) {
    std::string text;
    for (const CellRepeats& group : groups) {
        for (const TiedCell& repeat : group) {
            text += std::to_string(repeat.cell) + (repeat.is_mirrored ? "m " : " ");
        }
        text += "/ ";
    }
    return text;
}

/// Whether the second time of a beat of the loop is tied to the first.
bool is_tied(const std::vector<CellRepeats>& groups, std::size_t beat, bool is_mirrored) {
    return std::any_of(groups.begin(), groups.end(), [&](const CellRepeats& group) {
        return group.size() == 2 && group[0].cell == kFirst + beat && !group[0].is_mirrored &&
               group[1].cell == kSecond + beat && group[1].is_mirrored == is_mirrored;
    });
}

TEST(CellRepeats, a_planted_loop_is_found) {
    for (const bool is_mirrored : {false, true}) {
        const auto groups = find_cell_repeats(cells_of(with_loop(is_mirrored)));
        for (std::size_t beat = 0; beat < kLoop; ++beat) {
            EXPECT_TRUE(is_tied(groups, beat, is_mirrored)) << beat << ' ' << is_mirrored;
        }
        EXPECT_EQ(groups.size(), kLoop) << text_of(groups);
    }
}

TEST(CellRepeats, what_differs_too_much_stays_apart) {
    MadeTake take = with_loop(false);
    take.unlike = 0.5;
    EXPECT_TRUE(find_cell_repeats(cells_of(take)).empty());
    take.unlike = 0.0;
    EXPECT_TRUE(find_cell_repeats(cells_of(take), {.farthest = 0.0}).empty());
    EXPECT_TRUE(find_cell_repeats(cells_of(take), {.shortest_run = kLoop + 1}).empty());
}

TEST(CellRepeats, three_times_of_a_loop_are_one_group) {
    MadeTake take = with_loop(false);
    for (std::size_t i = 0; i <= kLoop; ++i) {
        take.keys[30 + i] = take.keys[kFirst + i];
    }
    const auto groups = find_cell_repeats(cells_of(take));
    ASSERT_EQ(groups.size(), kLoop) << text_of(groups);
    for (const CellRepeats& group : groups) {
        EXPECT_EQ(group.size(), 3U);
    }
}

CellTrainingReport learnt(const MadeTake& take, double farthest) {
    CellTrainingPlan plan;
    plan.beats = made_beats(take);
    plan.dance = "made";
    plan.ties.farthest = farthest;
    // All cells stay: of a take without repeats few hang together.
    plan.arcs.farthest = 60.0;
    plan.arcs.widest = 60.0;
    const TrainingClip clip = made_clip(take);
    return *train_cells(plan, std::span(&clip, 1));
}

TEST(CellRepeats, of_a_planted_loop_share_their_states) {
    MadeTake take = with_loop(false);
    take.unlike = 0.04;
    const CellTrainingReport report = learnt(take, 8.0);
    EXPECT_EQ(report.tied_cells, 2 * kLoop);
    EXPECT_EQ(report.figures, kLoop);
    // All but half a beat at either end of both runs.
    EXPECT_EQ(report.tied_states, 2 * (8 * kLoop - 8));
    ASSERT_EQ(report.dance.takes.size(), 1U);
    const CellTrainingReport untied = learnt(take, 0.0);
    const std::size_t chain = std::size_t{kStatesPerBeat} * (kSecond - kFirst);
    for (const PartModel& part : report.dance.takes[0].parts) {
        for (std::size_t k = std::size_t{kStatesPerBeat} * (kFirst + 2); k < 8 * (kFirst + kLoop);
             ++k) {
            for (std::size_t d = 0; d < part.dimension(); ++d) {
                const FigureState& own = part.states[k];
                const FigureState& other = part.states[k + chain];
                EXPECT_NEAR(own.mean[d], other.mean[d], 1e-9);
                EXPECT_NEAR(own.delta_mean[d], other.delta_mean[d], 1e-9);
                EXPECT_NEAR(own.delta_delta_mean[d], other.delta_delta_mean[d], 1e-9);
            }
        }
    }
    // Before they differ, and the mean lies between.
    const auto knee = [](const CellTrainingReport& of, std::size_t k) {
        return of.dance.takes[0].part(Part::lower).states[k].mean[3];
    };
    const std::size_t k = std::size_t{kStatesPerBeat} * (kFirst + 5);
    EXPECT_GT(std::abs(knee(untied, k) - knee(untied, k + chain)), 1e-4);
    EXPECT_NEAR(knee(report, k), 0.5 * (knee(untied, k) + knee(untied, k + chain)), 1e-3);
}

/// Root mean square of the third differences of what is solved from a take's states.
double solved_jerk(const FigureModel& take) {
    double sum = 0.0;
    double count = 0.0;
    for (const PartModel& part : take.parts) {
        const FeatureTrack track = most_likely_trajectory(part, take.samples());
        for (std::size_t i = 3; i < track.rows(); ++i) {
            for (std::size_t d = 0; d < track.columns; ++d) {
                const double third = track.row(i)[d] - 3.0 * track.row(i - 1)[d] +
                                     3.0 * track.row(i - 2)[d] - track.row(i - 3)[d];
                sum += third * third;
                ++count;
            }
        }
    }
    return std::sqrt(sum / count);
}

TEST(CellRepeats, do_not_show_where_they_begin_and_end) {
    MadeTake take = with_loop(false);
    take.unlike = 0.04;
    EXPECT_LT(solved_jerk(learnt(take, 8.0).dance.takes[0]),
              1.02 * solved_jerk(learnt(take, 0.0).dance.takes[0]));
}

}  // namespace
}  // namespace raks::motion
