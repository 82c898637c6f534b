#include "training/cells/take_grid.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "motion/figures/label_tables.hpp"

namespace raks::motion::take_grid_test {
namespace {

TEST(TakeGrid, is_written_as_it_is_read) {
    const auto beats = parse_take_beats(
        "take\ttime\thalf\tused\na\t0.1\t1\t1\nb\t2\t2\t0\na\t1.0166666666666666\t2\t1\n", "x");
    ASSERT_TRUE(beats);
    const std::vector<TakeGrid> grids = grids_of(*beats);
    ASSERT_EQ(grids.size(), 2U);
    EXPECT_EQ(grids[0].beats.size(), 2U);
    const std::vector<std::string> remarks = {"by hand"};
    const std::string text = grids_text(grids, remarks);
    EXPECT_EQ(text.substr(0, 10), "# by hand\n");
    const auto again = parse_take_beats(text, "x");
    ASSERT_TRUE(again);
    EXPECT_EQ(grids_of(*again), grids);
}

TEST(TakeGrid, behind_the_clip_is_refused_with_the_place) {
    const TakeGrid grid{"dance", {{1.0, 1, true}, {2.5, 2, true}}};
    EXPECT_TRUE(check_grid(grid, 2.5));
    const auto refused = check_grid(grid, 2.0);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "dance: beat 2 lies at 2.500 s, the clip ends at 2.000 s");
}

}  // namespace
}  // namespace raks::motion::take_grid_test
