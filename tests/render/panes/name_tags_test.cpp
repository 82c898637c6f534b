#include "render/panes/name_tags.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace raks::render {
namespace {

bool overlap(const Box& one, const Box& other) {
    return one.x < other.right() && other.x < one.right() && one.y < other.bottom() &&
           other.y < one.bottom();
}

constexpr Box kView{0.0F, 0.0F, 640.0F, 360.0F};

TEST(NameTags, stand_right_of_a_point_that_is_alone) {
    const auto boxes = place_tags({{100.0F, 50.0F}}, {40.0F}, 16.0F, kView);
    ASSERT_EQ(boxes.size(), 1U);
    EXPECT_GT(boxes[0].x, 100.0F);
    EXPECT_FLOAT_EQ(boxes[0].y + boxes[0].height / 2.0F, 50.0F);
}

TEST(NameTags, cover_neither_one_another_nor_a_point) {
    // As of wrist, hand and elbow, seen from the side.
    const std::vector<glm::vec2> points = {
        {100.0F, 100.0F}, {104.0F, 103.0F}, {96.0F, 108.0F}, {112.0F, 99.0F}, {140.0F, 101.0F}};
    const std::vector<float> widths(points.size(), 70.0F);
    const auto boxes = place_tags(points, widths, 16.0F, kView);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(overlap(boxes[i], boxes[j])) << i << " and " << j;
        }
        for (const glm::vec2& point : points) {
            EXPECT_FALSE(overlap(boxes[i], {point.x - 3.0F, point.y - 3.0F, 6.0F, 6.0F})) << i;
        }
    }
}

TEST(NameTags, are_seen_whole_at_the_edges_of_the_view) {
    for (const glm::vec2 point : {glm::vec2(5.0F, 180.0F),
                                  glm::vec2(635.0F, 180.0F),
                                  glm::vec2(320.0F, 2.0F),
                                  glm::vec2(320.0F, 358.0F),
                                  glm::vec2(638.0F, 358.0F)}) {
        const auto boxes = place_tags({point}, {90.0F}, 16.0F, kView);
        EXPECT_GE(boxes[0].x, 0.0F) << point.x;
        EXPECT_LE(boxes[0].right(), kView.width) << point.x;
        EXPECT_GE(boxes[0].y, 0.0F) << point.y;
        EXPECT_LE(boxes[0].bottom(), kView.height) << point.y;
    }
}

}  // namespace
}  // namespace raks::render
