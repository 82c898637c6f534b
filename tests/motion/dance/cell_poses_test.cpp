// When feet stand about the cells of a dance.
#include "motion/dance/cell_poses.hpp"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/motion/dance/cell_takes.hpp"

namespace raks::motion {
namespace {

bool stands(const DanceContent& content, const Cell& cell, double at, std::size_t side) {
    return take_pose(content, cell.take, cell.beat + at, false).foot_contact[side];
}

TEST(CellStands, are_when_the_feet_of_the_take_are_down) {
    const DanceContent& content = test::salsa_cell_content();
    const auto& cells = content.cells->cells;
    ASSERT_EQ(content.stands.size(), cells.size());
    std::size_t steps = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::size_t side = 0; side < 2; ++side) {
            const FootStand& stand = content.stands[i].after[side];
            const double until = content.stands[i].until[side];
            EXPECT_TRUE(until == -kCellJoin || stands(content, cells[i], 1.0 + until, side)) << i;
            EXPECT_TRUE(stand.from == kCellJoin || stands(content, cells[i], stand.from, side));
            if (stand.lands < kCellStep) {
                ++steps;
                EXPECT_LE(stand.from, stand.leaves);
                EXPECT_FALSE(stands(content, cells[i], stand.leaves, side)) << i;
                EXPECT_TRUE(stands(content, cells[i], stand.lands, side)) << i;
            }
        }
    }
    EXPECT_GT(steps, cells.size() / 2);
}

TEST(TakePose, mirrored_stands_with_the_other_foot) {
    const DanceContent& content = test::salsa_cell_content();
    for (const double beat : {0.0, 0.6, 2.3, 4.9}) {
        const Pose pose = take_pose(content, 0, beat, false);
        const Pose image = take_pose(content, 0, beat, true);
        EXPECT_EQ(pose.foot_contact[0], image.foot_contact[1]) << beat;
        EXPECT_EQ(pose.foot_contact[1], image.foot_contact[0]) << beat;
        EXPECT_EQ(pose.hips_position.y, image.hips_position.y) << beat;
    }
}

}  // namespace
}  // namespace raks::motion
