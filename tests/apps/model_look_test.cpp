#include "apps/xbody/model_look.hpp"

#include <gtest/gtest.h>

#include "tests/render/import/tiny_tds.hpp"

namespace raks::apps {
namespace {

/// A triangle on two joints, seen by two nodes with skins of their own.
render::Model twins() {
    render::Model model;
    model.nodes.resize(4);  // joints 0 and 1, shown by 2 and 3
    render::ModelPrimitive primitive;
    primitive.positions.resize(3);
    primitive.normals = {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, -1.0F}};
    primitive.joints = {{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}};
    primitive.weights = {
        {1.0F, 0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}, {0.5F, 0.5F, 0.0F, 0.0F}};
    primitive.indices = {0, 1, 2};
    model.meshes.push_back(
        {.name = "m", .primitives = {primitive}, .morph_names = {}, .morph_weights = {}});
    model.skins = {{.joints = {0, 1}, .inverse_bind = {}}, {.joints = {1, 0}, .inverse_bind = {}}};
    model.nodes[2].mesh = 0;
    model.nodes[2].skin = 0;
    model.nodes[3].mesh = 0;
    model.nodes[3].skin = 1;
    return model;
}

glm::vec3 colour(const render::Model& model, std::size_t node, std::size_t vertex) {
    const auto mesh = static_cast<std::size_t>(model.nodes[node].mesh);
    return glm::vec3(model.meshes[mesh].primitives[0].colours[vertex]);
}

TEST(ModelLook, weights_are_those_of_the_chosen_joint_in_each_nodes_own_skin) {
    const render::Model shown =
        looked(twins(), {.paint = ModelPaint::weights, .joint = 0, .is_hidden = {}});
    EXPECT_EQ(colour(shown, 2, 0), colour_of_weight(1.0F));
    EXPECT_EQ(colour(shown, 2, 1), colour_of_weight(0.0F));
    EXPECT_EQ(colour(shown, 2, 2), colour_of_weight(0.5F));
    EXPECT_EQ(colour(shown, 3, 0), colour_of_weight(0.0F));
    EXPECT_EQ(colour(shown, 3, 1), colour_of_weight(1.0F));
}

TEST(ModelLook, normals_are_colours_without_light) {
    const render::Model shown =
        looked(twins(), {.paint = ModelPaint::normals, .joint = -1, .is_hidden = {}});
    EXPECT_EQ(colour(shown, 2, 0), glm::vec3(1.0F, 0.5F, 0.5F));
    EXPECT_EQ(colour(shown, 2, 2), glm::vec3(0.5F, 0.5F, 0.0F));
    EXPECT_TRUE(shown.materials.back().is_unlit);
}

TEST(ModelLook, of_rigid_parts_the_chosen_one_is_red) {
    const auto read = test::tds::read(test::tds::figure());
    ASSERT_TRUE(read);
    std::size_t part = 0;
    while (read->nodes[part].mesh < 0) {
        ++part;
    }
    const render::Model shown = looked(
        *read, {.paint = ModelPaint::weights, .joint = static_cast<int>(part), .is_hidden = {}});
    for (std::size_t node = 0; node < shown.nodes.size(); ++node) {
        if (shown.nodes[node].mesh >= 0) {
            EXPECT_EQ(colour(shown, node, 0), colour_of_weight(node == part ? 1.0F : 0.0F)) << node;
        }
    }
}

TEST(ModelLook, hidden_nodes_have_no_mesh_and_others_keep_theirs) {
    const render::Model shown = looked(
        twins(), {.paint = ModelPaint::own, .joint = -1, .is_hidden = {false, false, true, false}});
    EXPECT_EQ(shown.nodes[2].mesh, -1);
    EXPECT_EQ(shown.nodes[3].mesh, 0);
    EXPECT_TRUE(shown.meshes[0].primitives[0].colours.empty());
}

}  // namespace
}  // namespace raks::apps
