#include "render/mannequin/paint_parts.hpp"

#include <gtest/gtest.h>

#include <array>

namespace raks::render {
namespace {

TEST(PaintParts, each_colour_has_its_triangles_vertices_and_morphs) {
    ModelPrimitive whole;
    whole.material = 3;
    for (int i = 0; i < 4; ++i) {
        whole.positions.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
    }
    whole.indices = {0, 1, 2, 1, 3, 2};
    whole.morphs = {{{0, 3}, {{0.0F, 1.0F, 0.0F}, {0.0F, 2.0F, 0.0F}}, {}}};
    const auto parts = paint_parts(whole, std::array{Paint::suit, Paint::hair});
    ASSERT_EQ(parts.size(), 2U);
    const ModelPrimitive& suit = parts.at(Paint::suit);
    EXPECT_EQ(suit.positions.size(), 3U);
    EXPECT_EQ(suit.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(suit.morphs[0].vertices, (std::vector<std::uint32_t>{0}));
    const ModelPrimitive& hair = parts.at(Paint::hair);
    EXPECT_EQ(hair.material, 3);
    EXPECT_EQ(hair.positions[1], glm::vec3(3.0F, 0.0F, 0.0F));
    EXPECT_EQ(hair.morphs[0].vertices, (std::vector<std::uint32_t>{1}));
    EXPECT_EQ(hair.morphs[0].positions[0], glm::vec3(0.0F, 2.0F, 0.0F));
    EXPECT_TRUE(hair.normals.empty());
}

}  // namespace
}  // namespace raks::render
