// Vertices that are alike become one.
#include "engine/import/weld.hpp"

#include <gtest/gtest.h>

namespace raks::engine {
namespace {

using Corners = std::vector<std::uint32_t>;

/// Two triangles of a square, each with its own three vertices.
render::ModelPrimitive square() {
    render::ModelPrimitive square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.indices = {0, 1, 2, 3, 4, 5};
    return square;
}

TEST(Weld, vertices_that_are_alike_become_one_in_the_order_in_which_they_are_met) {
    render::ModelPrimitive primitive = square();
    weld(primitive);
    EXPECT_EQ(primitive.positions.size(), 4U);
    EXPECT_EQ(primitive.indices, (Corners{0, 1, 2, 0, 2, 3}));
}

TEST(Weld, vertices_that_differ_in_anything_stay_apart) {
    render::ModelPrimitive primitive = square();
    primitive.weights.assign(6, {1.0F, 0.0F, 0.0F, 0.0F});
    primitive.joints.assign(6, {0, 0, 0, 0});
    primitive.joints[3] = {1, 0, 0, 0};
    weld(primitive);
    EXPECT_EQ(primitive.positions.size(), 5U);
    EXPECT_EQ(primitive.joints[3][0], 1);
}

TEST(Weld, morph_targets_follow_and_keep_apart_what_they_move_differently) {
    render::ModelPrimitive primitive = square();
    render::MorphTarget morph;
    morph.vertices = {0, 3, 4};
    morph.positions = {{0, 0, 1}, {0, 0, 1}, {0, 0, 2}};
    primitive.morphs = {morph};
    weld(primitive);
    EXPECT_EQ(primitive.indices, (Corners{0, 1, 2, 0, 3, 4}));
    EXPECT_EQ(primitive.morphs[0].vertices, (Corners{0, 3}));
    EXPECT_EQ(primitive.morphs[0].positions[1], glm::vec3(0, 0, 2));
}

}  // namespace
}  // namespace raks::engine
