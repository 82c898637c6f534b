// Springs and their colliders, and node constraints, of VRM 1.0 and 0.x.
#include <gtest/gtest.h>

#include <string>

#include "tests/render/import/vrm_text.hpp"

namespace {

using namespace raks;
using namespace raks::render;
using raks::test::ReadFigure;

ReadFigure read_springs(const std::string& text) {
    return raks::test::read_vrm1_text("",
                                      R"(,"VRMC_springBone":{"specVersion":"1.0",)" + text + "}");
}

/// A spring of these joints, with more fields in front.
ReadFigure read_spring(const std::string& joints, const std::string& more = "") {
    return read_springs(R"("springs":[{)" + more + R"("joints":[)" + joints + "]}]");
}

constexpr const char* kHair = R"({"node":15},{"node":16},{"node":17})";

TEST(SpringBone1, a_chain_keeps_its_joints_and_what_they_say) {
    const ReadFigure read = read_spring(
        R"({"node":15,"stiffness":2,"gravityPower":0.5,"gravityDir":[0,0,1],"dragForce":0.25,
        "hitRadius":0.02},{"node":16},{"node":17})",
        R"("name":"hair","center":2,)");
    ASSERT_EQ(read.error, "");
    ASSERT_EQ(read.model.character.springs.size(), 1U);
    const SpringChain& chain = read.model.character.springs[0];
    EXPECT_EQ(chain.name, "hair");
    EXPECT_EQ(chain.center, 2);
    EXPECT_FALSE(chain.has_virtual_tail);
    ASSERT_EQ(chain.joints.size(), 3U);
    EXPECT_EQ(chain.joints[0].node, 15);
    EXPECT_FLOAT_EQ(chain.joints[0].stiffness, 2.0F);
    EXPECT_FLOAT_EQ(chain.joints[0].gravity_power, 0.5F);
    EXPECT_FLOAT_EQ(chain.joints[0].gravity_direction.z, 1.0F);
    EXPECT_FLOAT_EQ(chain.joints[0].drag, 0.25F);
    EXPECT_FLOAT_EQ(chain.joints[0].hit_radius, 0.02F);
    EXPECT_FLOAT_EQ(chain.joints[1].stiffness, 1.0F);
    EXPECT_FLOAT_EQ(chain.joints[1].gravity_direction.y, -1.0F);
}

TEST(SpringBone1, a_chain_that_cannot_be_is_left_out_with_a_word) {
    struct Row {
        const char* joints;
        const char* warning;
    };
    for (const Row& row : {
             Row{R"({"node":15},{"node":15})", "does not lie below the joint before"},
             Row{R"({"node":17},{"node":16})", "does not lie below the joint before"},
             Row{R"({"node":15},{"node":700})", "700 does not exist: there are 18"},
             Row{"", "has no joints"},
         }) {
        const ReadFigure read = read_spring(row.joints);
        EXPECT_EQ(read.error, "");
        EXPECT_TRUE(read.model.character.springs.empty()) << row.joints;
        EXPECT_TRUE(read.warns(row.warning)) << row.joints;
    }
}

TEST(SpringBone1, one_joint_alone_is_no_fault) {
    const ReadFigure read = read_spring(R"({"node":15})");
    EXPECT_TRUE(read.model.character.springs.empty());
    EXPECT_FALSE(read.warns("spring"));
}

TEST(SpringBone1, numbers_out_of_range_are_clamped_and_said) {
    const ReadFigure read =
        read_spring(R"({"node":15,"stiffness":1e30,"dragForce":-5,"hitRadius":"NaN"},{"node":16})");
    ASSERT_EQ(read.model.character.springs.size(), 1U);
    const SpringJoint& joint = read.model.character.springs[0].joints[0];
    EXPECT_FLOAT_EQ(joint.stiffness, 1000.0F);
    EXPECT_FLOAT_EQ(joint.drag, 0.0F);
    EXPECT_FLOAT_EQ(joint.hit_radius, 0.0F);
    EXPECT_TRUE(read.warns("stiffness"));
    EXPECT_TRUE(read.warns("hitRadius: is a text, not a number; taken as 0"));
}

TEST(SpringBone1, a_node_swings_once_and_its_center_carries_it) {
    const ReadFigure twice = read_springs(std::string(R"("springs":[{"joints":[)") + kHair +
                                          R"(]},{"joints":[)" + kHair + "]}]");
    EXPECT_EQ(twice.model.character.springs.size(), 1U);
    EXPECT_TRUE(twice.warns("springs[1]: its node 15 swings in another spring already"));
    const ReadFigure inside = read_spring(kHair, R"("center":16,)");
    EXPECT_EQ(inside.model.character.springs.at(0).center, -1);
    EXPECT_TRUE(inside.warns("its center does not carry it"));
}

TEST(SpringBone1, colliders_have_all_five_shapes) {
    const std::string extended =
        R"("extensions":{"VRMC_springBone_extended_collider":{"specVersion":"1.0","shape":)";
    const ReadFigure read = read_springs(
        R"("colliders":[
          {"node":2,"shape":{"sphere":{"offset":[0,1,0],"radius":0.1}}},
          {"node":2,"shape":{"capsule":{"radius":0.1,"tail":[0,2,0]}}},
          {"node":2,"shape":{"sphere":{"radius":9}},)" +
        extended + R"({"sphere":{"radius":0.5,"inside":true}}}}},
          {"node":2,)" +
        extended + R"({"capsule":{"radius":0.5,"tail":[1,0,0],"inside":true}}}}},
          {"node":2,)" +
        extended + R"({"plane":{"normal":[0,2,0]}}}}}],
        "colliderGroups":[{"colliders":[0,1,2,3,4]}],
        "springs":[{"colliderGroups":[0],"joints":[)" +
        kHair + "]}]");
    ASSERT_EQ(read.error, "");
    const std::vector<SpringCollider>& all = read.model.character.colliders;
    ASSERT_EQ(all.size(), 5U);
    EXPECT_EQ(all[0].shape, ColliderShape::sphere);
    EXPECT_FLOAT_EQ(all[0].offset.y, 1.0F);
    EXPECT_EQ(all[1].shape, ColliderShape::capsule);
    EXPECT_FLOAT_EQ(all[1].tail.y, 2.0F);
    EXPECT_EQ(all[2].shape, ColliderShape::inside_sphere);
    EXPECT_FLOAT_EQ(all[2].radius, 0.5F);
    EXPECT_EQ(all[3].shape, ColliderShape::inside_capsule);
    EXPECT_EQ(all[4].shape, ColliderShape::plane);
    EXPECT_FLOAT_EQ(all[4].normal.y, 1.0F);
    EXPECT_EQ(read.model.character.springs.at(0).colliders, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(SpringBone1, a_bad_collider_costs_itself_and_a_bad_group_its_spring) {
    const ReadFigure read = read_springs(
        R"("colliders":[{"node":2},{"node":77,"shape":{"sphere":{}}},
          {"node":2,"shape":{"sphere":{"radius":-1}}}],
        "colliderGroups":[{"colliders":[0,1,2]}],
        "springs":[{"colliderGroups":[0],"joints":[)" +
        std::string(kHair) + R"(]},{"colliderGroups":[9],"joints":[{"node":3},{"node":4}]}])");
    ASSERT_EQ(read.model.character.colliders.size(), 1U);
    EXPECT_FLOAT_EQ(read.model.character.colliders[0].radius, 0.0F);
    ASSERT_EQ(read.model.character.springs.size(), 1U);
    EXPECT_EQ(read.model.character.springs[0].colliders, std::vector<int>{0});
    EXPECT_TRUE(read.warns("colliders[0].shape: is not a shape that is known; left out"));
    EXPECT_TRUE(read.warns("springs[1].colliderGroups[0]: 9"));
}

// ---- VRM 0.x

TEST(SpringBone0, a_subtree_becomes_chains_with_virtual_tails) {
    Model model = raks::test::small_figure();
    const int side = raks::test::add_node(model, "side", 15);  // a second branch of hair1
    const ReadFigure read = raks::test::read_document(
        R"({"extensions":{"VRM":{"humanoid":{"humanBones":[)" +
            raks::test::bones0(raks::test::small_figure()) +
            R"(]},"secondaryAnimation":{"boneGroups":[{"comment":"hair","bones":[15],
            "stiffiness":2,"dragForce":0.3,"hitRadius":0.05,"center":-1,
            "gravityDir":{"x":1,"y":-1,"z":0},"colliderGroups":[0]}],
            "colliderGroups":[{"node":2,"colliders":[{"radius":0.1,
            "offset":{"x":0.1,"y":0.2,"z":0.3}}]}]}}}})",
        model);
    ASSERT_EQ(read.error, "");
    const Character& character = read.model.character;
    ASSERT_EQ(character.springs.size(), 2U);
    const SpringChain& first = character.springs[0];
    EXPECT_TRUE(first.has_virtual_tail);
    ASSERT_EQ(first.joints.size(), 3U);
    EXPECT_EQ(first.joints[2].node, 17);
    EXPECT_FLOAT_EQ(first.joints[2].stiffness, 2.0F);
    EXPECT_FLOAT_EQ(first.joints[2].gravity_direction.x, -1.0F);
    ASSERT_EQ(character.springs[1].joints.size(), 1U);
    EXPECT_EQ(character.springs[1].joints[0].node, side);
    EXPECT_EQ(character.springs[1].colliders, std::vector<int>{0});
    ASSERT_EQ(character.colliders.size(), 1U);
    EXPECT_FLOAT_EQ(character.colliders[0].offset.z, -0.3F);
}

TEST(SpringBone0, a_group_of_nodes_that_are_not_there_is_left_out) {
    const ReadFigure read = raks::test::read_vrm0_text(
        R"(,"secondaryAnimation":{"boneGroups":[{"bones":[900]},{"bones":[15],
        "colliderGroups":[7]},{"bones":[16]}]})");
    ASSERT_EQ(read.error, "");
    ASSERT_EQ(read.model.character.springs.size(), 1U);
    EXPECT_EQ(read.model.character.springs[0].joints[0].node, 16);
    EXPECT_TRUE(read.warns("boneGroups[0].bones[0]: 900"));
    EXPECT_TRUE(read.warns("boneGroups[1].colliderGroups[0]: 7"));
}

TEST(SpringBone0, a_chain_ends_at_what_swings_already) {
    const ReadFigure read = raks::test::read_vrm0_text(
        R"(,"secondaryAnimation":{"boneGroups":[{"bones":[17]},{"bones":[15]}]})");
    ASSERT_EQ(read.model.character.springs.size(), 2U);
    const SpringChain& second = read.model.character.springs[1];
    ASSERT_EQ(second.joints.size(), 3U);
    EXPECT_EQ(second.joints[2].node, 17);
    EXPECT_FALSE(second.has_virtual_tail);
}

// ---- Constraints

/// Constraints of the first nodes of the figure: each a text, or empty.
ReadFigure read_constraints(std::initializer_list<std::string> constraints) {
    std::string nodes;
    for (const std::string& one : constraints) {
        nodes += nodes.empty() ? "" : ",";
        nodes += one.empty() ? "{}"
                             : R"({"extensions":{"VRMC_node_constraint":{"specVersion":"1.0",
                               "constraint":)" +
                                   one + "}}}";
    }
    return raks::test::read_vrm1_text("", "", R"(,"nodes":[)" + nodes + "]");
}

TEST(NodeConstraint, rotation_roll_and_aim_are_read) {
    const ReadFigure read = read_constraints({R"({"rotation":{"source":3,"weight":0.5}})",
                                              R"({"roll":{"source":3,"rollAxis":"Z"}})",
                                              R"({"aim":{"source":4,"aimAxis":"NegativeY"}})"});
    const std::vector<NodeConstraint>& all = read.model.character.constraints;
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].kind, ConstraintKind::rotation);
    EXPECT_FLOAT_EQ(all[0].weight, 0.5F);
    EXPECT_EQ(all[1].kind, ConstraintKind::roll);
    EXPECT_EQ(all[1].axis, NodeAxis::z);
    EXPECT_EQ(all[2].kind, ConstraintKind::aim);
    EXPECT_EQ(all[2].axis, NodeAxis::minus_y);
    EXPECT_EQ(all[2].source, 4);
}

TEST(NodeConstraint, each_comes_after_what_moves_its_source) {
    const ReadFigure read = read_constraints({"",
                                              "",
                                              R"({"rotation":{"source":4}})",
                                              R"({"rotation":{"source":6}})",
                                              R"({"rotation":{"source":7}})"});
    const std::vector<NodeConstraint>& all = read.model.character.constraints;
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].node, 3);  // carries 4, the source of 2
    EXPECT_EQ(all[1].node, 4);
    EXPECT_EQ(all[2].node, 2);
}

TEST(NodeConstraint, on_itself_in_a_circle_or_of_nothing_is_left_out) {
    const ReadFigure itself = read_constraints({R"({"rotation":{"source":0}})"});
    EXPECT_TRUE(itself.model.character.constraints.empty());
    EXPECT_TRUE(itself.warns("is the node itself"));
    const ReadFigure circle = read_constraints({"",
                                                "",
                                                "",
                                                R"({"rotation":{"source":9}})",
                                                "",
                                                "",
                                                "",
                                                "",
                                                "",
                                                R"({"rotation":{"source":3}})"});
    EXPECT_EQ(circle.model.character.constraints.size(), 1U);
    EXPECT_TRUE(circle.warns("follows itself, by way of others"));
    const ReadFigure nothing = read_constraints({R"({"rotation":{"source":900}})"});
    EXPECT_TRUE(nothing.model.character.constraints.empty());
    EXPECT_TRUE(nothing.warns("900 does not exist: there are 18"));
}

}  // namespace
