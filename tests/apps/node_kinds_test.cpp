#include "apps/xbody/node_kinds.hpp"

#include <gtest/gtest.h>

#include <string>

namespace raks::apps {
namespace {

int add(render::Model& model, int parent) {
    const int node = static_cast<int>(model.nodes.size());
    render::ModelNode& added = model.nodes.emplace_back();
    added.name = "node " + std::to_string(node);
    added.parent = parent;
    if (parent >= 0) {
        model.nodes[static_cast<std::size_t>(parent)].children.push_back(node);
    } else {
        model.roots.push_back(node);
    }
    return node;
}

TEST(NodeKinds, are_what_a_node_is_there_for_and_a_bone_before_all_else) {
    render::Model model;
    const int root = add(model, -1);
    const int hips = add(model, root);
    const int tail = add(model, hips);
    const int mesh = add(model, root);
    const int part = add(model, root);
    const int guard = add(model, hips);
    model.meshes.resize(1);
    model.skins.resize(1);
    model.nodes[static_cast<std::size_t>(mesh)].mesh = 0;
    model.nodes[static_cast<std::size_t>(mesh)].skin = 0;
    model.nodes[static_cast<std::size_t>(part)].mesh = 0;
    model.nodes[static_cast<std::size_t>(hips)].mesh = 0;
    model.character.colliders.push_back({.node = guard});
    model.character.colliders.push_back({.node = hips});
    render::SpringChain chain;
    chain.joints.push_back({.node = tail});
    model.character.springs.push_back(chain);
    render::HumanoidMap bones;
    bones.nodes[0] = hips;

    const std::vector<NodeKind> expected = {NodeKind::helper,
                                            NodeKind::bone,
                                            NodeKind::spring,
                                            NodeKind::mesh,
                                            NodeKind::part,
                                            NodeKind::collider};
    EXPECT_EQ(node_kinds(model, bones), expected);
    EXPECT_EQ(words_of(NodeKind::part), "rigid part");
}

TEST(SkeletonNodes, hang_from_the_nearest_one_above_that_is_drawn) {
    render::Model model;
    const int root = add(model, -1);
    const int hips = add(model, root);
    const int between = add(model, hips);
    const int spine = add(model, between);
    model.skins.push_back({.joints = {hips, spine}, .inverse_bind = {}});

    const std::vector<SkeletonNode> drawn = skeleton_nodes(model, {});
    ASSERT_EQ(drawn.size(), 2U);
    EXPECT_EQ(drawn[0].node, hips);
    EXPECT_EQ(drawn[0].parent, -1);
    EXPECT_EQ(drawn[1].node, spine);
    EXPECT_EQ(drawn[1].parent, hips);
}

TEST(SkeletonNodes, of_a_model_without_skins_are_its_rigid_parts) {
    render::Model model;
    const int root = add(model, -1);
    const int part = add(model, root);
    model.meshes.resize(1);
    model.nodes[static_cast<std::size_t>(part)].mesh = 0;

    const std::vector<SkeletonNode> drawn = skeleton_nodes(model, {});
    ASSERT_EQ(drawn.size(), 1U);
    EXPECT_EQ(drawn[0].node, part);
}

}  // namespace
}  // namespace raks::apps
