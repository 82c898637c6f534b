#include "motion/dance/cell_rows.hpp"

#include <gtest/gtest.h>

#include "tests/motion/dance/small_cells.hpp"

namespace raks::motion {
namespace {

CellStep step(int cell) { return {static_cast<std::uint16_t>(cell), cell % 3 == 0, true}; }

SongBars bars(int bar, double begins) {
    SongBars song;
    song.bar = bar;
    song.begins = begins;
    return song;
}

TEST(CellRows, give_a_bar_that_repeats_an_earlier_one_its_steps) {
    CellRows rows;
    for (int beat = 0; beat < 16; ++beat) {
        const int bar = beat / 4;
        const SongBars song = bars(bar, 4.0 * bar);
        rows.note(step(beat), beat, &song);
    }
    // Later, and after the phase was set back by a beat: bar 9 begins at 35 and repeats bar 2.
    SongBars song = bars(8, 31.0);
    song.repeats = {-1, 2, 3, -1};
    EXPECT_FALSE(rows.repeated(34.0, song)) << "bar 8 is new";
    for (int beat = 0; beat < 8; ++beat) {
        const auto again = rows.repeated(35.0 + beat, song);
        ASSERT_TRUE(again) << beat;
        EXPECT_TRUE(is_same_cell(*again, step(8 + beat)));
    }
    EXPECT_FALSE(rows.repeated(43.0, song)) << "bar 11 is new";
    EXPECT_FALSE(rows.repeated(47.0, song)) << "beyond what is told";
}

TEST(CellRows, know_nothing_of_bars_that_were_not_danced_or_are_out_of_range) {
    CellRows rows;
    SongBars song = bars(CellRows::kMostBars + 5, 0.0);
    rows.note(step(1), 0.0, &song);
    song.repeats = {3, 2'000, 0, 0};
    EXPECT_FALSE(rows.repeated(0.0, song));
    EXPECT_FALSE(rows.repeated(4.0, song));
    song = bars(2, 0.0);
    song.beats = CellRows::kMostBeats + 1;
    song.repeats = {0, 0, 0, 0};
    rows.note(step(1), 0.0, &song);
    EXPECT_FALSE(rows.repeated(0.0, song));
}

TEST(CellRows, keep_the_last_beats_as_a_loop) {
    const CellGraph graph = test::small_graph(1, 30, 0);
    CellRows rows;
    for (int beat = 0; beat < 20; ++beat) {
        rows.note({static_cast<std::uint16_t>(beat), false, false}, beat, nullptr);
    }
    rows.keep(graph);
    ASSERT_TRUE(rows.is_kept());
    for (int beat = 0; beat < 24; ++beat) {
        EXPECT_EQ(rows.kept(beat).cell, 12 + beat % 8);
    }
    rows.note(rows.kept(0), 20.0, nullptr);
    EXPECT_EQ(rows.kept(0).cell, 13) << "a beat later";
    rows.let_go();
    EXPECT_FALSE(rows.is_kept());
}

TEST(CellRows, keep_fewer_beats_where_only_then_the_end_leads_to_the_beginning) {
    CellGraph graph = test::small_graph(1, 30, 0);
    graph.arcs.push_back({14, false, 5.0F});
    for (std::size_t cell = 20; cell < graph.first_arc.size(); ++cell) {
        graph.first_arc[cell] = 1;
    }
    CellRows rows;
    for (int beat = 0; beat < 20; ++beat) {
        rows.note({static_cast<std::uint16_t>(beat), false, false}, beat, nullptr);
    }
    rows.keep(graph);
    for (int beat = 0; beat < 12; ++beat) {
        EXPECT_EQ(rows.kept(beat).cell, 14 + beat % 6);
    }
}

}  // namespace
}  // namespace raks::motion
