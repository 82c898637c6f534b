// Splitting a primitive by joints changes no triangle.
#include "render/avatar/skin_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

namespace raks::render {
namespace {

/// Triangles that lie apart, each on three joints of its own.
ModelPrimitive apart(std::uint16_t triangles) {
    ModelPrimitive primitive;
    primitive.morphs.emplace_back();
    for (std::uint16_t i = 0; i < 3 * triangles; ++i) {
        primitive.positions.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
        primitive.uv[0].emplace_back(static_cast<float>(i), 1.0F);
        primitive.joints.push_back({i, 0, 0, 0});
        primitive.weights.push_back({1.0F, 0.0F, 0.0F, 0.0F});
        primitive.indices.push_back(i);
        primitive.morphs[0].vertices.push_back(i);
        primitive.morphs[0].positions.emplace_back(0.0F, static_cast<float>(i), 0.0F);
    }
    return primitive;
}

TEST(SkinSplit, every_triangle_keeps_its_corners_joints_and_morphs) {
    constexpr std::size_t kMost = 20;
    const ModelPrimitive whole = apart(100);
    const std::vector<SkinnedPiece> pieces = split_by_joints(whole, kMost);
    EXPECT_EQ(pieces.size(), 17U);  // six triangles of three joints each
    std::size_t next = 0;
    for (const SkinnedPiece& piece : pieces) {
        EXPECT_LE(piece.joints.size(), kMost);
        const ModelPrimitive& part = piece.primitive;
        ASSERT_EQ(part.morphs.size(), 1U);
        for (const std::uint32_t index : part.indices) {
            const std::uint32_t of_whole = whole.indices[next++];
            EXPECT_EQ(part.positions[index], whole.positions[of_whole]);
            EXPECT_EQ(part.uv[0][index], whole.uv[0][of_whole]);
            EXPECT_EQ(piece.joints[part.joints[index][0]], whole.joints[of_whole][0]);
            const auto& moved = part.morphs[0].vertices;
            const auto place = std::find(moved.begin(), moved.end(), index);
            ASSERT_NE(place, moved.end());
            EXPECT_EQ(part.morphs[0].positions[static_cast<std::size_t>(place - moved.begin())].y,
                      whole.positions[of_whole].x);
        }
    }
    EXPECT_EQ(next, whole.indices.size());
}

TEST(SkinSplit, what_fits_stays_in_one_piece) {
    EXPECT_EQ(split_by_joints(apart(6), 18).size(), 1U);
    EXPECT_TRUE(split_by_joints({}, 18).empty());
}

}  // namespace
}  // namespace raks::render
