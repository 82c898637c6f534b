#include "render/import/vertex_influences.hpp"

#include <gtest/gtest.h>

namespace {

using namespace raks::render;

struct Merged {
    InfluenceFaults faults;
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{};
};

/// One vertex of so many sets of four.
Merged merged(std::vector<std::vector<std::uint32_t>> joints,
              std::vector<std::vector<float>> weights) {
    std::vector<std::array<std::uint16_t, 4>> four;
    std::vector<std::array<float, 4>> shares;
    Merged result;
    result.faults = merge_influences(
        {.vertices = 1, .joints = std::move(joints), .weights = std::move(weights)}, four, shares);
    result.joints = four[0];
    result.weights = shares[0];
    return result;
}

TEST(VertexInfluences, of_eight_the_four_that_weigh_most_are_kept) {
    const Merged found = merged({{1, 2, 3, 4}, {5, 6, 7, 8}},
                                {{0.1F, 0.4F, 0.05F, 0.05F}, {0.2F, 0.1F, 0.06F, 0.04F}});
    EXPECT_EQ(found.joints, (std::array<std::uint16_t, 4>{2, 5, 1, 6}));
    EXPECT_FLOAT_EQ(found.weights[0], 0.5F);
    EXPECT_FLOAT_EQ(found.weights[0] + found.weights[1] + found.weights[2] + found.weights[3], 1);
    EXPECT_TRUE(found.faults.has_more);
}

TEST(VertexInfluences, are_divided_by_their_sum) {
    const Merged found = merged({{1, 2, 0, 0}}, {{2, 1, 0, 0}});
    EXPECT_FLOAT_EQ(found.weights[0], 2.0F / 3.0F);
    EXPECT_TRUE(found.faults.has_other_sum);
    EXPECT_EQ(found.faults.uneven, 1U);
    EXPECT_FALSE(merged({{1, 2, 0, 0}}, {{0.6F, 0.39F, 0, 0}}).faults.has_other_sum);
    EXPECT_EQ(merged({{1, 2, 0, 0}}, {{0.6F, 0.39F, 0, 0}}).faults.uneven, 1U);
    EXPECT_EQ(merged({{1, 2, 0, 0}}, {{0.6F, 0.4F, 0, 0}}).faults.uneven, 0U);
}

TEST(VertexInfluences, that_are_negative_or_missing_are_mended) {
    const Merged negative = merged({{1, 2, 0, 0}}, {{2, -1, 0, 0}});
    EXPECT_TRUE(negative.faults.has_negative);
    EXPECT_FLOAT_EQ(negative.weights[0], 1);
    const Merged none = merged({{3, 2, 0, 0}}, {{0, 0, 0, 0}});
    EXPECT_TRUE(none.faults.has_none);
    EXPECT_EQ(none.joints[0], 3);
    EXPECT_FLOAT_EQ(none.weights[0], 1);
}

TEST(VertexInfluences, without_weight_are_no_reason_to_refuse_a_skin) {
    const Merged found = merged({{1, 200, 0, 0}}, {{1, 0, 0, 0}});
    EXPECT_EQ(found.faults.used, 1);
    EXPECT_EQ(found.faults.unused, 200);
    EXPECT_EQ(found.joints[1], 0);
}

}  // namespace
