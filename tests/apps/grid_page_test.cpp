#include "apps/reports/grid_page.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/training/discovery/stepping_dance.hpp"

namespace raks::apps::grid_page_test {
namespace {

TEST(GridPage, shows_every_beat_and_says_that_half_are_wrong) {
    motion::test::SteppingDance dance;
    dance.repeats = 2;
    std::vector<ProposedTake> takes(2);
    for (ProposedTake& take : takes) {
        take.clip = motion::test::stepping_clip(dance);
        take.cues = motion::grid_cues(take.clip);
    }
    takes[0].proposal.grid = {"<1>", {}};
    for (int i = 0; i < 10; ++i) {
        takes[0].proposal.grid.beats.push_back({1.0 + 0.36 * i, 1 + i % 2, i > 1});
    }
    takes[1].proposal.grid.take = "2";
    EXPECT_EQ(draw_grid(takes[0]), draw_grid(takes[0]));
    const std::string page = grid_page(draw_grid(takes[0]) + draw_grid(takes[1]));
    EXPECT_NE(page.find("right in about half"), std::string::npos);
    EXPECT_NE(page.find("<h2>&lt;1&gt;</h2>"), std::string::npos);
    EXPECT_NE(page.find("10 beats, 8 of them used; 167 BPM"), std::string::npos);
    EXPECT_NE(page.find("no beats"), std::string::npos);
    std::size_t heads = 0;
    for (std::size_t at = page.find(" r=\"4\""); at != std::string::npos;
         at = page.find(" r=\"4\"", at + 1)) {
        ++heads;
    }
    EXPECT_EQ(heads, 19U) << "a body on every beat and between two";
}

}  // namespace
}  // namespace raks::apps::grid_page_test
