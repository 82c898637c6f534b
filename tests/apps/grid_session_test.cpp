#include "apps/grid/grid_session.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "motion/figures/label_tables.hpp"

namespace raks::apps {
namespace {

using motion::GridBeat;

constexpr double kSeconds = 20.0;

/// Twelve beats, the first at 1 s, one each half second; the last two are not used.
motion::TakeGrid even_grid() {
    motion::TakeGrid grid{"take", {}};
    for (int i = 0; i < 12; ++i) {
        grid.beats.push_back({1.0 + 0.5 * i, 1 + i % 2, i < 10});
    }
    return grid;
}

/// Whether times rise with room between them, in the clip, and halves are 1 or 2.
void expect_sound(const GridBeats& beats, const std::string& after) {
    for (std::size_t i = 0; i < beats.size(); ++i) {
        EXPECT_GE(beats[i].time, 0.0) << after;
        EXPECT_LE(beats[i].time, kSeconds) << after;
        EXPECT_TRUE(beats[i].half == 1 || beats[i].half == 2) << after;
        if (i > 0) {
            EXPECT_GE(beats[i].time - beats[i - 1].time, kClosestBeats - 1e-9) << after;
        }
    }
}

class GridSessions : public ::testing::Test {
 protected:
    void act(const GridAction& action) { apply(action, session_); }
    [[nodiscard]] const GridBeats& beats() const { return session_.beats.now(); }

    GridSession session_ = grid_session(even_grid(), kSeconds);
};

/// An operation and what is chosen before it.
struct Operation {
    std::string name;
    std::vector<GridAction> actions;
};

std::vector<Operation> all_operations() {
    const GridAction choose = ChooseBeat{3};
    return {
        {"taps", {TapBeat{2.1}, TapBeat{2.62}, TapBeat{3.11}, EndTaps{}}},
        {"drag", {HoldBeat{{3, 2.61, true}}, LetGoOfBeat{}}},
        {"nudge", {choose, NudgeBeat{0.02}}},
        {"insert", {InsertBeat{2.75}}},
        {"insert before all", {InsertBeat{0.4}}},
        {"remove", {choose, RemoveBeat{}}},
        {"shift all", {ShiftBeats{0.1}}},
        {"shift a stretch", {MarkStretch{2.9, true}, MarkStretch{4.1, false}, ShiftBeats{-0.03}}},
        {"half", {HalveBeats{}}},
        {"double", {DoubleBeats{}}},
        {"even out", {HoldBeat{{11, 6.9, true}}, LetGoOfBeat{}, EvenBeats{}}},
        {"mark the 1", {choose, MarkOne{}}},
        {"leave out", {choose, ToggleUse{}}},
        {"leave a stretch out", {MarkStretch{1.9, true}, MarkStretch{3.6, false}, ToggleUse{}}},
        {"other beats", {ReplaceBeats{{{0.5, 1, true}, {1.1, 2, true}}}}}};
}

TEST_F(GridSessions, every_operation_can_be_taken_back_and_done_again) {
    for (const Operation& operation : all_operations()) {
        session_ = grid_session(even_grid(), kSeconds);
        for (const GridAction& action : operation.actions) {
            act(action);
        }
        const GridBeats changed = beats();
        EXPECT_NE(changed, even_grid().beats) << operation.name;
        EXPECT_FALSE(session_.is_saved()) << operation.name;
        expect_sound(changed, operation.name);
        while (session_.beats.can_undo()) {
            act(UndoGrid{});
        }
        EXPECT_EQ(beats(), even_grid().beats) << operation.name;
        EXPECT_TRUE(session_.is_saved()) << operation.name;
        while (session_.beats.can_redo()) {
            act(RedoGrid{});
        }
        EXPECT_EQ(beats(), changed) << operation.name;
    }
}

TEST_F(GridSessions, what_is_saved_is_read_back_equal_after_every_operation) {
    for (const Operation& operation : all_operations()) {
        session_ = grid_session(even_grid(), kSeconds);
        for (const GridAction& action : operation.actions) {
            act(action);
        }
        const motion::TakeGrid grid{"take", beats()};
        const auto read =
            motion::parse_take_beats(motion::grids_text(std::span(&grid, 1)), operation.name);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(motion::grids_of(*read), std::vector{grid}) << operation.name;
    }
}

TEST_F(GridSessions, a_run_of_taps_takes_the_place_of_beats_in_one_step) {
    act(TapBeat{2.1});
    act(TapBeat{2.6});
    EXPECT_EQ(beats(), even_grid().beats) << "until the run ends";
    EXPECT_EQ(session_.shown()[2].time, 2.1);
    act(TapBeat{3.2});
    act(EndTaps{});
    ASSERT_EQ(beats().size(), 12U);
    EXPECT_EQ(beats()[1], (GridBeat{1.5, 2, true}));
    EXPECT_EQ(beats()[2], (GridBeat{2.1, 1, true}));
    EXPECT_EQ(beats()[3], (GridBeat{2.6, 2, true}));
    EXPECT_EQ(beats()[4], (GridBeat{3.2, 1, true}));
    EXPECT_EQ(beats()[5], (GridBeat{3.5, 2, true}));
    act(UndoGrid{});
    EXPECT_EQ(beats(), even_grid().beats);
}

TEST_F(GridSessions, taps_behind_all_beats_go_on_from_the_last) {
    act(TapBeat{7.0});
    act(TapBeat{7.6});
    act(EndTaps{});
    ASSERT_EQ(beats().size(), 14U);
    EXPECT_EQ(beats()[12], (GridBeat{7.0, 1, true}));
    EXPECT_EQ(beats()[13], (GridBeat{7.6, 2, true}));
}

TEST_F(GridSessions, who_taps_after_going_back_begins_a_new_run) {
    act(TapBeat{3.0});
    act(TapBeat{3.5});
    act(TapBeat{1.1});
    EXPECT_EQ(session_.taps, std::vector{1.1});
    EXPECT_TRUE(session_.beats.can_undo() || beats() == even_grid().beats);
}

TEST_F(GridSessions, a_beat_is_dragged_no_farther_than_its_neighbours_and_the_clip) {
    act(HoldBeat{{3, 9.0, true}});
    EXPECT_EQ(beats(), even_grid().beats) << "until it is let go";
    act(LetGoOfBeat{});
    EXPECT_EQ(beats()[3].time, 3.0 - kClosestBeats);
    act(HoldBeat{{0, -5.0, true}});
    act(LetGoOfBeat{});
    EXPECT_EQ(beats()[0].time, 0.0);
    act(HoldBeat{{11, 99.0, true}});
    act(LetGoOfBeat{});
    EXPECT_EQ(beats()[11].time, kSeconds);
}

TEST_F(GridSessions, all_are_shifted_as_far_as_the_clip_allows) {
    act(ShiftBeats{-3.0});
    EXPECT_EQ(beats().front().time, 0.0);
    EXPECT_EQ(beats()[1].time, 0.5);
    act(ShiftBeats{100.0});
    EXPECT_EQ(beats().back().time, kSeconds);
}

TEST_F(GridSessions, half_undoes_double) {
    act(DoubleBeats{});
    ASSERT_EQ(beats().size(), 23U);
    EXPECT_EQ(beats()[1], (GridBeat{1.25, 2, true}));
    EXPECT_EQ(beats()[2], (GridBeat{1.5, 1, true}));
    act(HalveBeats{});
    EXPECT_EQ(beats(), even_grid().beats);
}

TEST_F(GridSessions, half_keeps_beats_of_the_first_half_and_what_is_wholly_used) {
    act(HalveBeats{});
    ASSERT_EQ(beats().size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(beats()[i],
                  (GridBeat{1.0 + static_cast<double>(i), 1 + static_cast<int>(i % 2), i < 5}));
    }
}

TEST_F(GridSessions, a_beat_more_or_less_turns_the_halves_behind_it) {
    act(InsertBeat{2.75});
    EXPECT_EQ(session_.chosen, 4U);
    EXPECT_EQ(beats()[4], (GridBeat{2.75, 1, true}));
    EXPECT_EQ(beats()[5], (GridBeat{3.0, 2, true}));
    act(RemoveBeat{});
    EXPECT_EQ(beats(), even_grid().beats);
    act(InsertBeat{3.02});
    EXPECT_EQ(beats(), even_grid().beats) << "there is one";
}

TEST_F(GridSessions, the_1_turns_all_that_follow_and_precede_without_a_gap) {
    GridBeats gap = even_grid().beats;
    gap.push_back({15.0, 1, true});
    gap.push_back({15.5, 2, true});
    session_ = grid_session({"take", gap}, kSeconds);
    act(ChooseBeat{3});
    act(MarkOne{});
    EXPECT_EQ(beats()[0].half, 2);
    EXPECT_EQ(beats()[3].half, 1);
    EXPECT_EQ(beats()[11].half, 1);
    EXPECT_EQ(beats()[12].half, 1) << "behind the gap";
    const GridBeats once = beats();
    act(MarkOne{});
    EXPECT_EQ(beats(), once);
}

TEST_F(GridSessions, a_stretch_is_left_out_and_used_again) {
    act(MarkStretch{1.9, true});
    act(MarkStretch{3.6, false});
    act(ToggleUse{});
    EXPECT_TRUE(beats()[1].is_used);
    for (std::size_t i = 2; i <= 5; ++i) {
        EXPECT_FALSE(beats()[i].is_used);
    }
    EXPECT_TRUE(beats()[6].is_used);
    act(ToggleUse{});
    EXPECT_EQ(beats(), even_grid().beats);
}

TEST_F(GridSessions, a_stretch_whose_end_comes_first_begins_anew) {
    act(MarkStretch{5.0, true});
    act(MarkStretch{3.0, false});
    EXPECT_EQ(session_.stretch, (GridStretch{0.0, 3.0}));
    act(ForgetChosen{});
    EXPECT_FALSE(session_.stretch);
}

TEST_F(GridSessions, nothing_happens_to_a_grid_without_beats_but_taps_and_inserts) {
    session_ = grid_session({"take", {}}, kSeconds);
    for (const Operation& operation : all_operations()) {
        GridSession empty = session_;
        for (const GridAction& action : operation.actions) {
            apply(action, empty);
        }
        expect_sound(empty.beats.now(), operation.name);
    }
    act(StepBeat{});
    EXPECT_FALSE(session_.chosen);
    act(InsertBeat{4.0});
    EXPECT_EQ(beats(), (GridBeats{{4.0, 1, true}}));
}

TEST_F(GridSessions, a_proposal_is_not_saved_before_it_is) {
    session_.is_new = true;
    EXPECT_FALSE(session_.is_saved());
    session_.mark_saved();
    EXPECT_TRUE(session_.is_saved());
    act(TapBeat{3.0});
    EXPECT_FALSE(session_.is_saved());
}

}  // namespace
}  // namespace raks::apps
