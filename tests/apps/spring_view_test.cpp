#include "apps/xbody/spring_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/xbody/skeleton_view.hpp"
#include "base/pending_file.hpp"
#include "tests/render/import/tiny_tds.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr render::Box kPicture{10.0F, 20.0F, 400.0F, 300.0F};

TEST(SpringView, draws_colliders_as_large_as_they_are_and_chains_from_joint_to_joint) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "me.3ds", test::tds::figure()));
    auto model =
        load_shown_model({.file = folder / "me.3ds", .options = {}, .motion = {}, .joints = {}});
    ASSERT_TRUE(model) << model.error().message;
    const ShownPose shown(*model);
    const render::HumanoidMap& humanoid = model->figure.model.character.humanoid;
    const auto node = [&](motion::Bone bone) { return humanoid.nodes[motion::index_of(bone)]; };
    render::Character& character = model->figure.model.character;
    character.colliders.push_back({.node = node(motion::Bone::head),
                                   .shape = render::ColliderShape::capsule,
                                   .offset = {},
                                   .tail = {0.0F, 0.1F, 0.0F},
                                   .radius = 0.1F});
    character.springs.push_back({.name = "tail",
                                 .joints = {{.node = node(motion::Bone::left_upper_arm)},
                                            {.node = node(motion::Bone::left_hand)}},
                                 .colliders = {}});
    const render::Camera camera =
        camera_before(*model, shown, "front", kPicture.width / kPicture.height);
    const SeenSprings seen = seen_springs(*model, shown, camera, kPicture);
    ASSERT_EQ(seen.rings.size(), 4U) << "two of the capsule, two of the chain";
    ASSERT_EQ(seen.lines.size(), 3U) << "two sides, one link";
    EXPECT_TRUE(seen.rings[0].is_collider);
    EXPECT_GT(seen.rings[0].radius, 3.0F);
    EXPECT_FALSE(seen.lines.back().is_collider);
    // The sides of a capsule are as far apart as it is broad.
    const float apart = glm::distance(seen.lines[0].from, seen.lines[1].from);
    EXPECT_NEAR(apart, 2.0F * seen.rings[0].radius, 0.1F);
    const auto skeleton = seen_skeleton(*model, shown, humanoid, {}, camera, kPicture);
    const auto hand = std::find_if(skeleton.begin(), skeleton.end(), [&](const SeenNode& one) {
        return one.node == node(motion::Bone::left_hand);
    });
    ASSERT_NE(hand, skeleton.end());
    EXPECT_LT(glm::distance(seen.lines.back().to, hand->at), 0.1F);
}

}  // namespace
}  // namespace raks::apps
