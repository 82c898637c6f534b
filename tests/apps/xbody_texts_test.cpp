#include "apps/xbody/xbody_texts.hpp"

#include <gtest/gtest.h>

#include "render/model/sub_meshes.hpp"

namespace raks::apps {
namespace {

/// A triangle that two joints move, one vertex of it with weights that do not sum to 1 in its file.
render::Model skinned_triangle() {
    render::Model model;
    render::ModelNode& node = model.nodes.emplace_back();
    node.name = "body";
    node.mesh = 0;
    node.skin = 0;
    model.roots = {0};
    model.skins.push_back({{0, 0}, {glm::mat4(1.0F), glm::mat4(1.0F)}});
    render::ModelPrimitive primitive;
    primitive.material = 0;
    primitive.positions = {{0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}};
    primitive.joints = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}};
    primitive.weights = {{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5F, 0, 0, 0}};
    primitive.uneven_weights = 1;
    primitive.indices = {0, 1, 2};
    primitive.morphs.resize(2);
    model.meshes.emplace_back().primitives.push_back(primitive);
    render::ModelMaterial& material = model.materials.emplace_back();
    material.name = "skin";
    material.base_texture.texture = 0;
    material.emissive_texture.texture = 0;
    model.textures.push_back({.image = 0});
    render::ModelImage& image = model.images.emplace_back();
    image.width = 64;
    image.height = 32;
    return model;
}

TEST(SubMeshes, are_counted) {
    const auto parts = render::sub_meshes(skinned_triangle());
    ASSERT_EQ(parts.size(), 1U);
    const render::SubMesh& part = parts.front();
    EXPECT_EQ(part.vertices, 3U);
    EXPECT_EQ(part.triangles, 1U);
    EXPECT_EQ(part.joints, 2U);
    EXPECT_EQ(part.uneven_weights, 1U);
    EXPECT_EQ(part.morphs, 2U);
    ASSERT_EQ(part.textures.size(), 1U) << "an image counts once";
    EXPECT_EQ(part.textures.front(), std::pair(64, 32));
    ASSERT_TRUE(part.box);
    EXPECT_EQ(part.box->high, glm::vec3(2.0F, 1.5F, 0.0F)) << "as it is drawn";
}

TEST(XbodyTexts, say_what_a_part_is_made_of_and_warn_of_weights) {
    const auto lines = mesh_lines(skinned_triangle());
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_EQ(lines[0].text, "body / skin");
    EXPECT_EQ(lines[1].text, "3 vertices, 1 triangles, 64x32");
    EXPECT_EQ(lines[2].text, "2 joints, 2 morph targets");
    EXPECT_EQ(lines[3].text, "box 2 x 1.5 x 0");
    EXPECT_TRUE(lines[4].is_warning);
}

TEST(XbodyTexts, break_at_spaces_and_long_words_where_they_must) {
    EXPECT_EQ(wrapped("one two three", 7), (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(wrapped("abcdefgh", 3), (std::vector<std::string>{"abc", "def", "gh"}));
    EXPECT_EQ(wrapped("", 3), std::vector<std::string>{""});
}

}  // namespace
}  // namespace raks::apps
