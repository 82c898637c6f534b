// How the cells of a dance hang together, of graphs whose ways are known.
#include "motion/cells/cell_survey.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace raks::motion {
namespace {

// Two takes of three cells each: 0 1 2 | 3 4 5. Arcs: 2 to 0, 5 to 3, and 5 to 1.
CellGraph two_takes() {
    CellGraph graph;
    graph.takes = {{"a", 5}, {"b", 5}};
    for (std::uint16_t i = 0; i < 6; ++i) {
        Cell cell;
        cell.take = static_cast<std::uint16_t>(i / 3);
        cell.beat = static_cast<std::uint16_t>(1 + i % 3);
        cell.energy = i == 1 ? 2.0F : 1.0F + 0.01F * static_cast<float>(i);
        cell.speed_at_end = 1.0F;
        graph.cells.push_back(cell);
    }
    graph.first_arc = {0, 0, 0, 1, 1, 1, 3};
    graph.arcs = {{0, false, 1.0F}, {3, true, 4.0F}, {1, false, 100.0F}};
    sort_energies(graph);
    return graph;
}

TEST(CellSurvey, counts_who_reaches_whom) {
    const CellSurvey found = survey(two_takes());
    EXPECT_EQ(found.connected, 3U) << "the first take comes to itself, never to the second";
    EXPECT_EQ(found.ends, 2U);
    EXPECT_EQ(found.without, 4U);
    EXPECT_EQ(found.most_arcs, 2U);
    EXPECT_EQ(found.between[0][0], 1U);
    EXPECT_EQ(found.between[1][0], 1U);
    EXPECT_EQ(found.between[0][1], 0U);
    EXPECT_EQ(found.distances[0], 1U);
    EXPECT_EQ(found.distances[1], 1U);
    EXPECT_EQ(found.distances[CellSurvey::kSteps - 1], 1U);
}

TEST(CellSurvey, says_how_far_it_is_to_cells_of_a_kind) {
    CellGraph graph = two_takes();
    EXPECT_EQ(survey(graph).rest.cells, 0U);
    // The last cell of the second take rests: from the first one no way leads there.
    graph.cells[5].stands_at_end = true;
    graph.cells[5].speed_at_end = 0.1F;
    const CellSurvey found = survey(graph);
    EXPECT_EQ(found.rest.cells, 1U);
    EXPECT_EQ(found.rest.cut_off, 3U);
    EXPECT_EQ(found.rest.farthest, 2);
    EXPECT_DOUBLE_EQ(found.rest.mean_beats, 1.5);
    EXPECT_EQ(found.ending.cells, 0U) << "it is of the first half";
    EXPECT_EQ(found.greatest.cells, 2U) << "the second and the last";
    EXPECT_EQ(found.greatest.cut_off, 0U);
    EXPECT_EQ(found.greatest.farthest, 2);
}

}  // namespace
}  // namespace raks::motion
