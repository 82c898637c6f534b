#include "engine/trials/trained_figures.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raks::engine {
namespace {

using motion::Cell;

// Beats 1 to 3 of a take of five are cells.
motion::CellDance short_dance() {
    motion::CellDance dance;
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

TEST(TakesOf, a_dance_of_cells_are_to_land_when_the_take_did) {
    const std::vector<motion::FigureModel> takes = takes_of(short_dance());
    ASSERT_EQ(takes.size(), 1U);
    const int least = motion::JudgedLandings().least_repeats;
    for (std::size_t beat = 0; beat < 5; ++beat) {
        const motion::LandingOffset& left = takes[0].landings[0][beat];
        const bool is_cell = beat >= 1 && beat <= 3;
        EXPECT_EQ(left.is_one(least, takes[0].repeats), is_cell) << beat;
        if (is_cell) {
            EXPECT_NEAR(left.median.count(), 0.1 * static_cast<double>(beat), 1e-6);
        }
        EXPECT_FALSE(takes[0].landings[1][beat].is_one(least, takes[0].repeats)) << beat;
    }
}

}  // namespace
}  // namespace raks::engine
