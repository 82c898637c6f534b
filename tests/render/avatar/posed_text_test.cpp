#include "render/avatar/posed_text.hpp"

#include <gtest/gtest.h>

#include "tests/render/avatar/tiny_model.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

// Two triangles: one without normals on the root, one with on a node 1 m up.
Model two_triangles() {
    Model model;
    add_node(model, "low", -1, {});
    add_node(model, "high\tone", 0, {0, 1, 0});
    ModelPrimitive plain;
    plain.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    plain.indices = {0, 1, 2};
    ModelPrimitive shaded = plain;
    shaded.normals = {{0, 0, 2}, {0, 0, 2}, {0, 0, 2}};
    model.meshes.resize(2);
    model.meshes[0].primitives = {plain};
    model.meshes[1].primitives = {shaded};
    model.nodes[0].mesh = 0;
    model.nodes[1].mesh = 1;
    return model;
}

TEST(PosedText, an_object_for_each_primitive_and_counts_that_go_on) {
    const Model model = two_triangles();
    const AvatarRig rig = build_rig(model);
    EXPECT_EQ(obj_text(model, rig, RigState(rig), "two\ntriangles"),
              "# two?triangles\n"
              "o node0.mesh0.primitive0\n"
              "v 0.000000 0.000000 0.000000\n"
              "v 1.000000 0.000000 0.000000\n"
              "v 0.000000 1.000000 0.000000\n"
              "f 1 2 3\n"
              "o node1.mesh1.primitive0\n"
              "v 0.000000 1.000000 0.000000\n"
              "v 1.000000 1.000000 0.000000\n"
              "v 0.000000 2.000000 0.000000\n"
              "vn 0.0000 0.0000 1.0000\n"
              "vn 0.0000 0.0000 1.0000\n"
              "vn 0.0000 0.0000 1.0000\n"
              "f 4//1 5//2 6//3\n");
}

TEST(PosedText, materials_lie_in_a_file_beside_it_under_names_without_spaces) {
    Model model = two_triangles();
    model.materials.resize(2);
    model.materials[0].name = "red silk";
    model.materials[0].base_colour = {1.0F, 0.25F, 0.0F, 0.5F};
    model.meshes[1].primitives[0].material = 0;
    const AvatarRig rig = build_rig(model);
    const std::string text = obj_text(model, rig, RigState(rig), "x", "x.mtl");
    EXPECT_EQ(text.find("# x\nmtllib x.mtl\no node0.mesh0.primitive0\nv "), 0U);
    EXPECT_NE(text.find("o node1.mesh1.primitive0\nusemtl 0_red_silk\nv "), std::string::npos);
    EXPECT_EQ(mtl_text(model),
              "newmtl 0_red_silk\nKd 1.000000 0.250000 0.000000\nd 0.500000\nillum 1\n"
              "newmtl 1_\nKd 1.000000 1.000000 1.000000\nd 1.000000\nillum 1\n");
}

TEST(PosedText, a_table_of_all_joints) {
    const AvatarRig rig = build_rig(two_triangles());
    EXPECT_EQ(joint_heads() + joint_lines(rig, RigState(rig), 7),
              "frame\tnode\tname\tx\ty\tz\n"
              "7\t0\tlow\t0.000000\t0.000000\t0.000000\n"
              "7\t1\thigh?one\t0.000000\t1.000000\t0.000000\n");
}

}  // namespace
}  // namespace raks::render
