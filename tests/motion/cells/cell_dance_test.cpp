// What the takes of a dance of cells have from its cells.
#include "motion/cells/cell_dance.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/evaluate/landing_error.hpp"

namespace raks::motion {
namespace {

// Beats 1 to 3 of a take of five are cells.
CellDance short_dance() {
    CellDance dance;
    dance.takes.resize(1);
    dance.takes[0].name = "take";
    dance.takes[0].beats = 5;
    for (std::uint16_t beat = 1; beat <= 3; ++beat) {
        Cell cell;
        cell.beat = beat;
        cell.landings = {0.1F * static_cast<float>(beat), Cell::kNoLanding};
        dance.graph.cells.push_back(cell);
    }
    return dance;
}

TEST(CellDance, takes_are_to_land_at_their_cells_when_the_dancer_did) {
    CellDance dance = short_dance();
    give_landings(dance);
    const std::vector<FigureModel>& takes = dance.takes;
    ASSERT_EQ(takes.size(), 1U);
    const int least = JudgedLandings().least_repeats;
    for (std::size_t beat = 0; beat < 5; ++beat) {
        const LandingOffset& left = takes[0].landings[0][beat];
        const bool is_cell = beat >= 1 && beat <= 3;
        EXPECT_EQ(left.is_one(least, takes[0].repeats), is_cell) << beat;
        if (is_cell) {
            EXPECT_NEAR(left.median.count(), 0.1 * static_cast<double>(beat), 1e-6);
        }
        EXPECT_FALSE(takes[0].landings[1][beat].is_one(least, takes[0].repeats)) << beat;
    }
}

}  // namespace
}  // namespace raks::motion
