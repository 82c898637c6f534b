// What the takes of a dance of cells have from its cells.
#include "motion/cells/cell_dance.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/evaluate/landing_error.hpp"

namespace raks::motion {
namespace {

// Beats 1 to 3 of a take of five are cells. The left foot comes down .1 to .3 beat after each of
// them and stands until the next one, but at beat 2 it is at the top of a kick.
CellDance short_dance() {
    CellDance dance;
    dance.takes.resize(1);
    dance.takes[0].name = "take";
    dance.takes[0].beats = 5;
    for (std::vector<double>& chances : dance.takes[0].contact) {
        chances.clear();
        for (int bin = 0; bin < 5 * kContactBinsPerBeat; ++bin) {
            chances.push_back(bin / kContactBinsPerBeat == 2 ? 0.0 : 1.0);
        }
    }
    for (std::uint16_t beat = 1; beat <= 3; ++beat) {
        Cell cell;
        cell.beat = beat;
        cell.landings = {0.1F * static_cast<float>(beat), Cell::kNoLanding};
        dance.graph.cells.push_back(cell);
    }
    return dance;
}

TEST(CellDance, takes_are_to_land_when_the_dancer_came_to_stand) {
    CellDance dance = short_dance();
    give_landings(dance);
    const std::vector<FigureModel>& takes = dance.takes;
    ASSERT_EQ(takes.size(), 1U);
    const int least = JudgedLandings().least_repeats;
    for (std::size_t beat = 0; beat < 5; ++beat) {
        const LandingOffset& left = takes[0].landings[0][beat];
        const bool lands = beat == 1 || beat == 3;
        EXPECT_EQ(left.is_one(least, takes[0].repeats), lands) << beat;
        if (lands) {
            EXPECT_NEAR(left.median.count(), 0.1 * static_cast<double>(beat), 1e-6);
        }
        EXPECT_FALSE(takes[0].landings[1][beat].is_one(least, takes[0].repeats)) << beat;
    }
}

}  // namespace
}  // namespace raks::motion
