#include "render/avatar/skin_vertices.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/random.hpp"
#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models

constexpr std::size_t kMatrices = 20;

std::vector<glm::mat4> some_matrices() {
    const CounterRandom random(1);
    std::vector<glm::mat4> matrices;
    for (std::size_t i = 0; i < kMatrices; ++i) {
        const glm::vec3 axis(
            random.normal(6 * i), random.normal(6 * i + 1), random.normal(6 * i + 2));
        const glm::vec3 shift(random.uniform(200 + i), random.uniform(300 + i), 0.5);
        matrices.push_back(
            glm::rotate(glm::translate(glm::mat4(1.0F), shift), 1.0F, glm::normalize(axis)));
    }
    return matrices;
}

ModelPrimitive some_primitive(std::size_t count) {
    const CounterRandom random(2);
    ModelPrimitive primitive;
    for (std::size_t i = 0; i < count; ++i) {
        const auto number = [&](std::size_t k) { return random.uniform(16 * i + k); };
        primitive.positions.emplace_back(number(0), number(1), number(2));
        primitive.normals.emplace_back(number(3), number(4), number(5));
        std::array<float, 4> weights{};
        float left = 1.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            weights[k] = i % 4 == k ? 0.0F : left * static_cast<float>(number(6 + k));
            left -= weights[k];
        }
        weights[0] += left;
        primitive.weights.push_back(weights);
        std::array<std::uint16_t, 4> joints{};
        for (std::size_t k = 0; k < 4; ++k) {
            joints[k] = static_cast<std::uint16_t>(random.below(16 * i + 10 + k, kMatrices));
        }
        primitive.joints.push_back(joints);
    }
    return primitive;
}

TEST(SkinVertices, every_vertex_is_the_weighted_sum_of_its_joints) {
    const std::vector<glm::mat4> matrices = some_matrices();
    const ModelPrimitive primitive = some_primitive(101);
    PosedVertices posed;
    pose_vertices(primitive, {}, matrices, posed);
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        glm::vec4 position(0.0F);
        glm::vec4 normal(0.0F);
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::mat4& matrix = matrices[primitive.joints[i][k]];
            position +=
                primitive.weights[i][k] * (matrix * glm::vec4(primitive.positions[i], 1.0F));
            normal += primitive.weights[i][k] * (matrix * glm::vec4(primitive.normals[i], 0.0F));
        }
        EXPECT_LT(glm::distance(posed.positions[i], glm::vec3(position)), 1e-5F) << i;
        EXPECT_LT(glm::distance(posed.normals[i], glm::vec3(normal)), 1e-5F) << i;
    }
}

TEST(SkinVertices, a_part_without_joints_goes_with_its_node) {
    ModelPrimitive primitive = some_primitive(3);
    primitive.joints.clear();
    primitive.weights.clear();
    primitive.normals.clear();
    const std::vector<glm::mat4> matrices = some_matrices();
    PosedVertices posed;
    pose_vertices(primitive, {}, matrices, posed);
    EXPECT_TRUE(posed.normals.empty());
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 expected(matrices[0] * glm::vec4(primitive.positions[i], 1.0F));
        EXPECT_LT(glm::distance(posed.positions[i], expected), 1e-6F);
    }
}

TEST(SkinVertices, morphs_move_before_joints_do) {
    ModelPrimitive primitive = some_primitive(4);
    primitive.morphs.resize(2);
    primitive.morphs[1].vertices = {1, 3};
    primitive.morphs[1].positions = {glm::vec3(1, 0, 0), glm::vec3(0, 2, 0)};
    primitive.morphs[1].normals = {glm::vec3(0, 0, 1), glm::vec3(0, 0, 2)};
    ModelPrimitive moved = primitive;
    moved.positions[1] += glm::vec3(0.5F, 0, 0);
    moved.positions[3] += glm::vec3(0, 1, 0);
    moved.normals[1] += glm::vec3(0, 0, 0.5F);
    moved.normals[3] += glm::vec3(0, 0, 1);
    PosedVertices by_morph;
    PosedVertices expected;
    const std::vector<float> weights = {1.0F, 0.5F};
    pose_vertices(primitive, weights, some_matrices(), by_morph);
    pose_vertices(moved, {}, some_matrices(), expected);
    EXPECT_EQ(by_morph.positions, expected.positions);
    EXPECT_EQ(by_morph.normals, expected.normals);
}

TEST(SkinVertices, matrices_are_joints_times_bind_or_the_nodes_own) {
    Model model;
    const int body = add_node(model, "body", -1, {5, 5, 5});
    const int bone = add_node(model, "bone", -1, {0, 2, 0});
    const int part = add_node(model, "part", bone, {1, 0, 0});
    ModelSkin skin;
    skin.joints = {part, bone};
    skin.inverse_bind = {glm::translate(glm::mat4(1.0F), glm::vec3(0, 0, 3)), glm::mat4(1.0F)};
    model.skins.push_back(skin);
    model.nodes[static_cast<std::size_t>(body)].skin = 0;
    const JointTree tree = build_joint_tree(model);
    const JointState state = rest_state(tree.joints);
    ASSERT_EQ(matrix_count(model, body), 2U);
    std::vector<glm::mat4> matrices(2);
    skinning_matrices(model, tree, state, body, matrices);
    EXPECT_EQ(matrices[0][3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(matrices[1][3], glm::vec4(0, 2, 0, 1));
    ASSERT_EQ(matrix_count(model, part), 1U);
    skinning_matrices(model, tree, state, part, matrices);
    EXPECT_EQ(matrices[0][3], glm::vec4(1, 2, 0, 1));
}

TEST(SkinVertices, posing_again_is_real_time_safe) {
    const std::vector<glm::mat4> matrices = some_matrices();
    const ModelPrimitive primitive = some_primitive(500);
    PosedVertices posed;
    pose_vertices(primitive, {}, matrices, posed);
    raks::test::RealtimeScope scope;
    pose_vertices(primitive, {}, matrices, posed);
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::render
