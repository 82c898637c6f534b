// The bind pose in the world, whatever space a mesh has of its own.
#include "render/import/bind_places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/import/humanoid_map.hpp"
#include "render/import/standing_body.hpp"
#include "tests/render/import/skinned_figure.hpp"

namespace raks::render::bind_places_test {
namespace {

using motion::Bone;

/// A space of a mesh, as exporters leave it.
struct Space {
    const char* name;
    glm::mat4 from_world;
};

std::vector<Space> spaces() {
    const glm::mat4 one(1.0F);
    return {
        {"the world", one},
        {"centimetres", glm::scale(one, glm::vec3(100.0F))},
        {"inches, moved", glm::translate(glm::scale(one, glm::vec3(39.37F)), {3.0F, -1.0F, 2.0F})},
        {"z up", glm::rotate(one, glm::radians(90.0F), glm::vec3(1.0F, 0.0F, 0.0F))},
        {"z up, facing -y, millimetres",
         glm::rotate(glm::rotate(glm::scale(one, glm::vec3(1000.0F)),
                                 glm::radians(90.0F),
                                 glm::vec3(1.0F, 0.0F, 0.0F)),
                     glm::radians(180.0F),
                     glm::vec3(0.0F, 1.0F, 0.0F))},
    };
}

void expect_same_places(const Model& model, const std::vector<glm::mat4>& truth, float slack) {
    const std::vector<glm::mat4> world = bind_world(model);
    for (std::size_t node = 0; node < truth.size(); ++node) {
        EXPECT_LT(glm::distance(glm::vec3(world[node][3]), glm::vec3(truth[node][3])), slack)
            << model.nodes[node].name;
    }
}

TEST(BindPlaces, of_a_mesh_in_any_space_are_where_its_joints_rest) {
    const std::vector<glm::mat4> truth = rest_world(raks::test::skinned_figure());
    const MeshBox box = mesh_box(raks::test::skinned_figure(), truth);
    for (const Space& space : spaces()) {
        SCOPED_TRACE(space.name);
        Model model = raks::test::skinned_figure();
        raks::test::move_mesh_space(model, space.from_world);
        expect_same_places(model, truth, 1e-4F);
        const MeshBox drawn = mesh_box(model, bind_world(model));
        EXPECT_LT(glm::distance(drawn.highest, box.highest), 1e-4F);
        EXPECT_LT(glm::distance(drawn.lowest, box.lowest), 1e-4F);
        ASSERT_TRUE(map_humanoid(model));
        const StandingBody standing = stand_up(model);
        EXPECT_FLOAT_EQ(standing.scale, 1.0F);
        EXPECT_NEAR(standing.height, box.highest.y - box.lowest.y, 1e-3F);
    }
}

TEST(BindPlaces, under_a_scaled_root_are_where_its_joints_rest) {
    // A skeleton in centimetres under a root that makes metres of them.
    Model model;
    const int root = raks::test::add_node(model, "root", -1);
    model.nodes[0].scale = glm::vec3(0.01F);
    for (const ModelNode& node : raks::test::figure_of_joints().nodes) {
        raks::test::add_node(
            model, node.name, node.parent < 0 ? root : node.parent + 1, 100.0F * node.translation);
    }
    raks::test::add_skin(model, std::vector<glm::vec3>(model.nodes.size(), {0.01F, 0.01F, 0.0F}));
    const std::vector<glm::mat4> truth = rest_world(model);
    for (const Space& space : spaces()) {
        SCOPED_TRACE(space.name);
        Model moved = model;
        raks::test::move_mesh_space(moved, space.from_world);
        expect_same_places(moved, truth, 1e-4F);
    }
}

TEST(BindPlaces, of_a_figure_that_is_stored_in_a_pose_stand_upright_at_its_size) {
    const std::vector<glm::mat4> truth = rest_world(raks::test::skinned_figure());
    for (const Space& space : spaces()) {
        SCOPED_TRACE(space.name);
        Model model = raks::test::skinned_figure();
        raks::test::move_mesh_space(model, space.from_world);
        // It leans, and bends an arm.
        model.nodes[0].rotation = glm::angleAxis(0.4F, glm::vec3(1.0F, 0.0F, 0.0F));
        model.nodes[6].rotation = glm::angleAxis(1.0F, glm::vec3(0.0F, 0.0F, 1.0F));
        const std::vector<glm::mat4> world = bind_world(model);
        for (const Bone bone : {Bone::head, Bone::left_hand, Bone::right_foot}) {
            const auto node = static_cast<std::size_t>(raks::test::node_named(
                model, std::string(motion::kBoneNames[motion::index_of(bone)])));
            // About the hips, as the way that it faces is not asked here.
            const auto off = [&](const std::vector<glm::mat4>& places) {
                return glm::vec3(places[node][3] - places[0][3]);
            };
            EXPECT_NEAR(off(world).y, off(truth)[1], 1e-3F);
            EXPECT_NEAR(glm::length(off(world)), glm::length(off(truth)), 1e-3F);
        }
    }
}

TEST(BindPlaces, of_skins_in_spaces_of_their_own_agree) {
    // A glove beside the body: bound in centimetres, to the forearm and the hand alone.
    Model model = raks::test::skinned_figure();
    const std::vector<glm::mat4> truth = rest_world(model);
    ModelSkin& glove = model.skins.emplace_back();
    const glm::mat4 centimetres = glm::scale(glm::mat4(1.0F), glm::vec3(0.01F));
    for (const int joint : {7, 8}) {
        glove.joints.push_back(joint);
        glove.inverse_bind.push_back(model.skins[0].inverse_bind[static_cast<std::size_t>(joint)] *
                                     centimetres);
    }
    std::swap(model.skins[0], model.skins[1]);
    model.nodes.back().skin = 1;
    expect_same_places(model, truth, 1e-4F);
}

TEST(BindPlaces, of_a_root_that_is_scaled_away_are_numbers) {
    Model model = raks::test::skinned_figure();
    model.nodes[0].scale = glm::vec3(0.0F);
    for (const glm::mat4& world : bind_world(model)) {
        EXPECT_TRUE(std::isfinite(world[3].x + world[3].y + world[3].z));
    }
}

}  // namespace
}  // namespace raks::render::bind_places_test
