#include "training/cells/cell_arcs.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.hpp"
#include "training/cells/cell_reach.hpp"

namespace raks::motion {
namespace {

/// A body whose hands are so far out, at rest; metres.
TakeMoment with_hands_at(double x) {
    TakeMoment moment;
    for (glm::dvec3& place : moment.places) {
        place = {0.0, 1.0, 0.0};
    }
    moment.places[7] = {x, 1.0, 0.0};
    moment.places[8] = {-x, 1.0, 0.0};
    return moment;
}

/// A take whose hands are at these places at its beats.
std::vector<CellSource> take_of(std::uint16_t number, const std::vector<double>& hands) {
    std::vector<CellSource> cells;
    for (std::size_t i = 0; i + 1 < hands.size(); ++i) {
        CellSource source;
        source.cell.take = number;
        source.cell.beat = static_cast<std::uint16_t>(i + 1);
        source.cell.is_second_half = i % 2 == 1;
        source.start = with_hands_at(hands[i]);
        source.end = with_hands_at(hands[i + 1]);
        cells.push_back(source);
    }
    return cells;
}

TEST(TakeMoments, mirrored_twice_are_the_same) {
    TakeMoment moment = with_hands_at(0.4);
    moment.places[7].y = 1.5;
    moment.hips_velocity = {0.3, 0.7};
    moment.turning = 0.5;
    moment.is_planted = {true, false};
    EXPECT_NEAR(distance(mirrored(mirrored(moment)), moment), 0.0, 1e-9);
    EXPECT_GT(distance(mirrored(moment), moment), 1.0);
}

TEST(TakeMoments, are_as_far_apart_as_their_joints) {
    // Two of fifteen joints, 30 cm: sqrt(2 x 30^2 / 15).
    EXPECT_NEAR(distance(with_hands_at(0.1), with_hands_at(0.4)), 10.95, 0.01);
}

TEST(CellArcs, a_planted_loop_is_found) {
    // The fourth beat ends as the first begins.
    const ReachedCells joined =
        reached_cells(join_cells(take_of(0, {0.0, 1.0, 2.0, 3.0, 0.0})).graph);
    EXPECT_EQ(joined.graph.cells.size(), 4U);
    const auto arcs = joined.graph.arcs_of(3);
    ASSERT_FALSE(arcs.empty());
    EXPECT_EQ(arcs[0].to, 0U);
    EXPECT_FALSE(joined.graph.has_successor(3));
    EXPECT_TRUE(joined.graph.has_successor(0));
}

TEST(CellArcs, what_is_reached_from_nothing_is_left_out) {
    auto cells = take_of(0, {0.0, 1.0, 2.0, 3.0, 0.0});
    const auto other = take_of(1, {9.0, 10.0, 11.0, 12.0, 0.0});
    cells.insert(cells.end(), other.begin(), other.end());
    EXPECT_EQ(reached_cells(join_cells(cells).graph).graph.cells.size(), 4U);
}

TEST(CellArcs, are_wider_only_where_cells_would_be_left_out) {
    // A second loop whose hands are 0.55 m further out: 20 cm on the mean.
    auto cells = take_of(0, {0.0, 1.0, 2.0, 3.0, 0.0});
    const auto other = take_of(1, {0.55, 1.55, 2.55, 3.55, 0.55});
    cells.insert(cells.end(), other.begin(), other.end());
    const JoinedCells joined = join_cells(cells);
    EXPECT_EQ(joined.wide_joins, 2U);
    EXPECT_EQ(reached_cells(joined.graph).graph.cells.size(), 8U);
    const JoinedCells narrow = join_cells(cells, {.widest = 18.0});
    EXPECT_EQ(narrow.wide_joins, 0U);
    EXPECT_EQ(reached_cells(narrow.graph).graph.cells.size(), 4U);
}

TEST(CellArcs, lead_from_one_half_of_the_bar_to_the_other) {
    std::vector<double> hands;
    const CounterRandom random(5);
    for (std::uint64_t i = 0; i < 60; ++i) {
        hands.push_back(random.uniform(i));
    }
    const CellGraph graph = join_cells(take_of(0, hands)).graph;
    EXPECT_GT(graph.arcs.size(), 50U);
    for (std::size_t cell = 0; cell < graph.cells.size(); ++cell) {
        for (const CellArc& arc : graph.arcs_of(cell)) {
            EXPECT_NE(graph.cells[arc.to].is_second_half, graph.cells[cell].is_second_half);
        }
    }
}

TEST(CellArcs, more_cells_than_a_dancer_remembers_are_refused) {
    CellGraph graph;
    graph.takes.push_back({"long", 60'000});
    for (std::size_t beat = 0; beat <= kMostCells; ++beat) {
        Cell cell;
        cell.beat = static_cast<std::uint16_t>(beat);
        graph.cells.push_back(cell);
        graph.first_arc.push_back(0);
    }
    graph.first_arc.push_back(1);
    graph.arcs.push_back({});
    const auto refused = validate(graph);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "there are 2049 cells of 1 takes, must be 1 to 2048 of at least one take");
    graph.cells.pop_back();
    graph.first_arc.erase(graph.first_arc.begin());
    EXPECT_TRUE(validate(graph));
}

TEST(CellArcs, one_cell_makes_no_dance) {
    EXPECT_FALSE(validate(join_cells(take_of(0, {0.0, 1.0})).graph));
}

}  // namespace
}  // namespace raks::motion
