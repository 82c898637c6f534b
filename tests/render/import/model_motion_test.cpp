// Clips of models as motion: of a VRMA that we write, and of a rig that turns and scales over its
// joints, as modelling programs export it.
#include "render/import/model_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/pending_file.hpp"
#include "motion/skeleton/formats/vrma.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::render::model_motion_test {
namespace {

using motion::Bone;
using motion::ClipWorldPose;
using motion::MotionClip;

std::string message(const Expected<MotionClip>& clip) {
    return clip ? "read" : clip.error().message;
}

TEST(ModelMotion, a_vrma_gives_back_the_places_and_names_of_its_bones) {
    std::vector<motion::Pose> poses(7);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const float angle = 0.2F * static_cast<float>(i);
        poses[i].hips_position = {0.1F * angle, 0.93F, -0.2F};
        poses[i].rotation(Bone::hips) = glm::angleAxis(angle, glm::vec3(0, 1, 0));
        poses[i].rotation(Bone::left_upper_arm) = glm::angleAxis(-angle, glm::vec3(0, 0, 1));
        poses[i].rotation(Bone::right_lower_leg) = glm::angleAxis(angle, glm::vec3(1, 0, 0));
    }
    const raks::test::TemporaryFolder folder;
    const motion::Skeleton& body = motion::mannequin_skeleton();
    ASSERT_TRUE(motion::write_vrma(folder / "x.vrma", body, poses, 25.0));
    const auto clip = read_model_motion(folder / "x.vrma", "", std::nullopt);
    ASSERT_TRUE(clip) << message(clip);
    EXPECT_EQ(clip->metres_per_unit, 1.0);
    EXPECT_EQ(clip->up, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_NEAR(clip->frames_per_second, 25.0, 1e-3);  // of its keys
    ASSERT_EQ(clip->frame_count, poses.size());
    ASSERT_EQ(clip->joints.size(), motion::kBoneNames.size());
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const ClipWorldPose world = motion::world_pose(*clip, frame);
        const motion::WorldPose truth = motion::world_pose(body, poses[frame]);
        for (std::size_t j = 0; j < clip->joints.size(); ++j) {
            const auto* const bone = std::find(
                motion::kBoneNames.begin(), motion::kBoneNames.end(), clip->joints[j].name);
            ASSERT_NE(bone, motion::kBoneNames.end()) << clip->joints[j].name;
            const auto index = static_cast<std::size_t>(bone - motion::kBoneNames.begin());
            const glm::dvec3 place(truth.positions[index]);
            EXPECT_LT(glm::distance(world.positions[j], place), 1e-5) << *bone;
            EXPECT_NEAR(std::abs(glm::dot(world.rotations[j], glm::dquat(truth.rotations[index]))),
                        1.0,
                        1e-5)
                << *bone;
        }
    }
    // At another rate it is as long as before.
    EXPECT_EQ(read_model_motion(folder / "x.vrma", "", 100.0)->frame_count, 25U);
    EXPECT_NE(message(read_model_motion(folder / "x.vrma", "walk", std::nullopt)).find("\"walk\""),
              std::string::npos);
}

// An armature in centimetres that lies on its back until its root turns it, two joints and a mesh:
// the lower joint's own axes are turned by a quarter about y, and a key bends it.
Model rig() {
    Model model;
    const glm::quat lying = glm::angleAxis(glm::radians(-90.0F), glm::vec3(1, 0, 0));
    const glm::quat aside = glm::angleAxis(glm::radians(90.0F), glm::vec3(0, 0, 1));
    model.nodes.resize(5);
    const auto node = [&](int index, const char* name, int parent) -> ModelNode& {
        ModelNode& made = model.nodes[static_cast<std::size_t>(index)];
        made.name = name;
        made.parent = parent;
        if (parent >= 0) {
            model.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
        }
        return made;
    };
    ModelNode& armature = node(0, "Armature", -1);
    armature.rotation = lying;
    armature.scale = glm::vec3(0.01F);
    // z is up in the armature.
    ModelNode& hips = node(1, "Hips", 0);
    hips.translation = {0, 0, 100};
    hips.rotation = aside;
    node(2, "Spine", 1).translation = {0, 0, 50};
    node(3, "Spine_end", 2).translation = {0, 0, 25};
    ModelNode& body = node(4, "Body", 0);
    body.mesh = body.skin = 0;
    model.roots = {0};
    model.meshes.resize(1);
    model.skins.push_back({{1, 2}, {}});
    AnimationChannel bend;
    bend.node = 2;
    bend.path = ChannelPath::rotation;
    bend.times = {0.5F, 1.5F};
    const float half = std::sqrt(0.5F);
    bend.values = {0, 0, 0, 1, half, 0, 0, half};  // a quarter turn about its own x
    model.animations.push_back({"bend", {bend}});
    return model;
}

TEST(ModelMotion, what_turns_and_scales_over_the_joints_is_in_their_places) {
    const Model model = rig();
    const auto clip = model_motion(model, 0, 10.0);
    ASSERT_TRUE(clip) << message(clip);
    ASSERT_EQ(clip->joints.size(), 2U);
    EXPECT_EQ(clip->joints[0].name, "Hips");
    EXPECT_EQ(clip->joints[1].name, "Spine");
    EXPECT_EQ(clip->frame_count, 11U);  // from the first key to the last
    const auto expect_place = [](const glm::dvec3& place, const glm::dvec3& truth) {
        EXPECT_LT(glm::distance(place, truth), 1e-6) << place.x << " " << place.y << " " << place.z;
    };
    // At rest joints have the world's axes: nothing is turned there.
    expect_place(clip->joints[0].offset, {0.0, 1.0, 0.0});
    expect_place(clip->joints[1].offset, {0.0, 0.5, 0.0});
    expect_place(*clip->joints[1].end_site, {0.0, 0.25, 0.0});
    EXPECT_NEAR(std::abs(clip->rotation(0, 1).w), 1.0, 1e-6);
    const auto tip = [&](std::size_t frame) {
        const ClipWorldPose world = motion::world_pose(*clip, frame);
        return world.positions[1] + world.rotations[1] * *clip->joints[1].end_site;
    };
    expect_place(tip(0), {0.0, 1.75, 0.0});
    // The joint's own x is the armature's y, which is the world's -z: from up a quarter turn about
    // that leads to +x.
    expect_place(tip(10), {0.25, 1.5, 0.0});
}

TEST(ModelMotion, clips_that_are_none_are_refused) {
    Model model = rig();
    EXPECT_EQ(find_animation(model, "bend").value(), 0U);
    EXPECT_NE(find_animation(model, "bent").error().message.find("did you mean \"bend\"?"),
              std::string::npos);
    Model still = model;
    still.animations[0].channels.clear();
    EXPECT_EQ(message(model_motion(still, 0, std::nullopt)), "its clip moves no joints");
    Model endless = model;
    endless.animations[0].channels[0].times[1] = std::numeric_limits<float>::max();
    EXPECT_NE(message(model_motion(endless, 0, std::nullopt)).find("which is too long"),
              std::string::npos);
    Model far = model;
    far.nodes[2].translation.z = 1e30F;
    EXPECT_NE(message(model_motion(far, 0, std::nullopt)).find("farther apart"), std::string::npos);
    model.animations.clear();
    EXPECT_EQ(find_animation(model, "").error().message, "there is no clip in it");
}

}  // namespace
}  // namespace raks::render::model_motion_test
