#include "training/cells/cell_reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace raks::motion {
namespace {

/// Cells of takes of their own, so that only arcs lead anywhere.
CellGraph graph_of(std::size_t cells, const std::vector<std::pair<int, int>>& arcs) {
    CellGraph graph;
    for (std::size_t i = 0; i < cells; ++i) {
        graph.takes.push_back({"take", 3});
        Cell cell;
        cell.take = static_cast<std::uint16_t>(i);
        cell.beat = 1;
        cell.speed_at_end = 1.0F;
        graph.cells.push_back(cell);
        graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
        for (const auto& [from, to] : arcs) {
            if (from == static_cast<int>(i)) {
                graph.arcs.push_back({static_cast<std::uint16_t>(to), false, 5.0F});
            }
        }
    }
    graph.first_arc.push_back(static_cast<std::uint32_t>(graph.arcs.size()));
    return graph;
}

/// A core of 20 cells in which each leads to the next two, and a way of `beats` cells that begins
/// and ends at its cell 0.
CellGraph core_with_way(int beats) {
    std::vector<std::pair<int, int>> arcs;
    for (int i = 0; i < 20; ++i) {
        arcs.emplace_back(i, (i + 1) % 20);
        arcs.emplace_back(i, (i + 5) % 20);
    }
    arcs.emplace_back(0, 20);
    for (int i = 0; i < beats; ++i) {
        arcs.emplace_back(20 + i, i + 1 < beats ? 21 + i : 0);
    }
    return graph_of(static_cast<std::size_t>(20 + beats), arcs);
}

void rest_at(CellGraph& graph, std::size_t cell) {
    graph.cells[cell].speed_at_end = 0.0F;
    graph.cells[cell].stands_at_end = true;
    graph.cells[cell].is_second_half = true;
}

TEST(CellReach, the_largest_part_that_hangs_together_stays) {
    // A ring of three, one of two that it leads to, and one cell alone.
    const ReachedCells reached =
        reached_cells(graph_of(6, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 3}}));
    EXPECT_EQ(reached.graph.cells.size(), 3U);
    EXPECT_EQ(reached.fates,
              (std::vector{CellFate::stays,
                           CellFate::stays,
                           CellFate::stays,
                           CellFate::apart,
                           CellFate::apart,
                           CellFate::apart}));
    EXPECT_EQ(reached.graph.arcs.size(), 3U);
    EXPECT_FALSE(reached.has_rests);
}

TEST(CellReach, a_way_that_is_far_from_every_rest_is_left_out) {
    CellGraph graph = core_with_way(12);
    rest_at(graph, 0);
    const ReachedCells reached = reached_cells(graph);
    EXPECT_TRUE(reached.has_rests);
    EXPECT_TRUE(reached.has_endings);
    EXPECT_EQ(reached.graph.cells.size(), 20U);
    EXPECT_EQ(reached.fates[20], CellFate::far);
    EXPECT_EQ(reached.fates[31], CellFate::apart);  // nothing leads to it any more
    for (std::size_t cell = 0; cell < 20; ++cell) {
        EXPECT_EQ(reached.fates[cell], CellFate::stays);
    }
    // A rest on the way keeps it.
    rest_at(graph, 26);
    EXPECT_EQ(reached_cells(graph).graph.cells.size(), 32U);
}

TEST(CellReach, what_the_dance_has_not_is_not_asked_for) {
    const ReachedCells without = reached_cells(core_with_way(12));
    EXPECT_EQ(without.graph.cells.size(), 32U);
    EXPECT_FALSE(without.has_rests);
    CellGraph first_halves = core_with_way(4);
    rest_at(first_halves, 3);
    first_halves.cells[3].is_second_half = false;
    const ReachedCells reached = reached_cells(first_halves);
    EXPECT_TRUE(reached.has_rests);
    EXPECT_FALSE(reached.has_endings);
}

TEST(CellReach, the_greatest_are_a_tenth) {
    CellGraph graph = core_with_way(4);
    for (std::size_t cell = 0; cell < graph.cells.size(); ++cell) {
        graph.cells[cell].energy = static_cast<float>(cell);
    }
    const CellGraph kept = reached_cells(graph).graph;
    int greatest = 0;
    for (std::size_t cell = 0; cell < kept.cells.size(); ++cell) {
        greatest += is_greatest(kept, cell) ? 1 : 0;
    }
    EXPECT_EQ(greatest, 4);  // of 24: those from the quantile of .9 on
}

TEST(CellReach, no_cell_and_one_cell_make_no_dance) {
    EXPECT_TRUE(reached_cells(CellGraph()).graph.cells.empty());
    const ReachedCells one = reached_cells(graph_of(1, {}));
    EXPECT_TRUE(one.graph.arcs.empty());
}

}  // namespace
}  // namespace raks::motion
