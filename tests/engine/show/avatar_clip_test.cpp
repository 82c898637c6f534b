#include "engine/show/avatar_clip.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "base/pending_file.hpp"
#include "engine/show/avatar_model.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/skeleton/formats/vmd_maker.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;
using motion::Bone;

const fs::path kModels = fs::path(RAKS_SOURCE_DIR) / "tests" / "data" / "avatars";

glm::vec3 hips() { return motion::mannequin_skeleton().offsets[0]; }

Expected<AvatarClip> clip_of(const std::string& name) {
    return AvatarClip::load((kModels / name).string(), hips());
}

// The mannequin stands in this pose: no head below its hips, no feet above.
void expect_upright(const motion::Pose& pose) {
    const motion::WorldPose world = motion::world_pose(motion::mannequin_skeleton(), pose);
    EXPECT_GT(world.position(Bone::head).y, world.position(Bone::hips).y + 0.4F);
    for (const Bone foot : {Bone::left_foot, Bone::right_foot}) {
        EXPECT_LT(world.position(foot).y, world.position(Bone::hips).y - 0.4F);
        EXPECT_NEAR(world.position(foot).y, 0.15F, 0.25F);
    }
}

TEST(AvatarClip, a_models_own_clip_moves_the_mannequin) {
    const auto clip = clip_of("RiggedFigure.glb");
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_GT(clip->duration(), 1.0);
    for (int i = 0; i <= 10; ++i) {
        expect_upright(clip->pose_at(clip->duration() * i / 10.0));
    }
    const motion::Pose first = clip->pose_at(0.0);
    const motion::Pose later = clip->pose_at(clip->duration() / 2.0);
    EXPECT_NE(first.local_rotations, later.local_rotations);
}

// Not from where the file has them, nor by the lowest point of all that is in it.
TEST(AvatarClip, a_models_own_clip_goes_from_where_its_hips_rest) {
    const fs::path file = kModels / "RiggedFigure.glb";  // its clip does not move the hips
    const glm::vec3 rest(0.3F, 5.0F, -2.0F);
    AvatarClipOptions options;
    options.avatar = file;
    for (const std::optional<float> scale : {std::optional<float>(), std::optional(2.0F)}) {
        options.own_scale = scale;
        const auto clip = AvatarClip::load(file.string(), rest, options);
        ASSERT_TRUE(clip) << clip.error().message;
        EXPECT_LT(glm::distance(clip->pose_at(clip->duration() / 3.0).hips_position, rest), 1e-4F);
    }
}

TEST(AvatarClip, the_first_of_several_clips_is_said) {
    const auto first = clip_of("kenney_character.glb");
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_NE(first->choice().find("kenney_character.glb holds 4 clips"), std::string::npos)
        << first->choice();
    EXPECT_TRUE(clip_of("RiggedFigure.glb")->choice().empty());
}

TEST(AvatarClip, a_vrma_moves_the_mannequin) {
    const auto clip = clip_of("six_poses.vrma");
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_GT(clip->duration(), 0.5);
    EXPECT_EQ(clip->rate(), 60.0);
}

TEST(AvatarClip, a_motion_of_mikumikudance_moves_body_and_face) {
    const test::TemporaryFolder folder;
    test::VmdMaker maker;
    maker.count(2).bone(test::kVmdCenter, 0, {0, 0, 0}).bone(test::kVmdCenter, 30, {0, -2, 0});
    // The morph "a", whose two bytes are these.
    maker.count(2).morph("\x82\xA0", 0, 0.0F).morph("\x82\xA0", 30, 1.0F);
    ASSERT_TRUE(write_file(folder / "x.vmd", maker.bytes()));
    const auto clip = AvatarClip::load((folder / "x.vmd").string(), hips());
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->rate(), 30.0);
    EXPECT_EQ(clip->duration(), 1.0);
    expect_upright(clip->pose_at(1.0));
    EXPECT_NEAR(
        clip->pose_at(0.0).hips_position.y - clip->pose_at(1.0).hips_position.y, 0.16F, 0.01F);
    EXPECT_NEAR(clip->face_at(0.5)->weight(render::FaceExpression::aa), 0.5F, 1e-4F);
    EXPECT_EQ(clip->face_at(9.0)->weight(render::FaceExpression::aa), 1.0F);
}

TEST(AvatarClip, a_figure_of_a_written_dance_moves_the_body_round_and_round) {
    const fs::path dance = fs::path(RAKS_SOURCE_DIR) / "config" / "choreographies" / "waltz.toml";
    const auto clip = AvatarClip::load(dance.string() + "#balance", hips());
    ASSERT_TRUE(clip) << clip.error().message;
    const auto small = AvatarClip::load(dance.string() + "#balance", 0.5F * hips());
    ASSERT_TRUE(small) << small.error().message;
    EXPECT_GT(clip->duration(), 3.0);
    for (int i = 0; i <= 10; ++i) {
        const double seconds = clip->duration() * i / 10.0;
        expect_upright(clip->pose_at(seconds));
        EXPECT_EQ(small->pose_at(seconds).hips_position,
                  0.5F * clip->pose_at(seconds).hips_position);
    }
    EXPECT_EQ(clip->pose_at(-1.0).local_rotations, clip->pose_at(0.0).local_rotations);
    EXPECT_NE(clip->pose_at(1.0).local_rotations, clip->pose_at(0.0).local_rotations);
    const auto none = AvatarClip::load(dance.string() + "#balanse", hips());
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("balance"), std::string::npos) << none.error().message;
}

TEST(AvatarClip, what_is_no_clip_is_said_with_its_file) {
    const auto message_of = [](const std::string& name) {
        const auto clip = clip_of(name);
        EXPECT_FALSE(clip) << name;
        return clip ? std::string() : clip.error().message;
    };
    EXPECT_NE(message_of("sphere.vrm").find("sphere.vrm: there is no clip in it"),
              std::string::npos);
    EXPECT_NE(
        message_of("RiggedFigure.glb#walk").find("RiggedFigure.glb: clip \"walk\" is unknown"),
        std::string::npos);
    EXPECT_NE(message_of("../bvh/odd/blank_lines.bvh#walk").find("which has no name"),
              std::string::npos);
    EXPECT_NE(message_of("SimpleSkin.gltf").find("SimpleSkin.gltf: no humanoid is found"),
              std::string::npos);
}

TEST(AvatarModel, is_as_tall_as_is_asked_for) {
    const auto own = load_avatar_model(kModels / "RiggedFigure.glb");
    const auto tall =
        load_avatar_model(kModels / "RiggedFigure.glb", {.height = 2.9F, .labels = {}});
    ASSERT_TRUE(own && tall);
    EXPECT_FLOAT_EQ(own->options.scale, 1.0F);
    EXPECT_NEAR(tall->options.scale, 2.9F / 1.45F, 0.01F);
}

TEST(AvatarModel, a_label_file_says_which_nodes_are_bones) {
    const test::TemporaryFolder folder;
    const fs::path labels = folder / "labels.toml";
    const std::string head = "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n";
    const auto load = [&](const std::string& bones, const char* model = "RiggedFigure.glb") {
        EXPECT_TRUE(write_file(labels, head + bones));
        return load_avatar_model(kModels / model, {.height = {}, .labels = labels});
    };
    const auto said = load("leftHand = \"arm_joint_L_3\"\n");
    ASSERT_TRUE(said) << said.error().message;
    const auto hand = motion::index_of(Bone::left_hand);
    EXPECT_EQ(said->model.character.humanoid.reasons[hand], render::BoneReason::label);
    const auto wrong = load("leftHand = \"claw\"\n");  // the others hold
    ASSERT_TRUE(wrong) << wrong.error().message;
    ASSERT_FALSE(wrong->model.warnings.empty());
    EXPECT_NE(wrong->model.warnings.front().find("no node \"claw\"; left out"), std::string::npos);
    EXPECT_NE(load("leftHnd = \"claw\"\n").error().message.find("leftHand"), std::string::npos);
    // VRM says so itself: the file is not needed, and that is said.
    const auto vrm = load("leftHand = \"claw\"\n", "smoke_spring.vrm");
    ASSERT_TRUE(vrm) << vrm.error().message;
    ASSERT_FALSE(vrm->model.warnings.empty());
    EXPECT_NE(vrm->model.warnings.back().find("not needed"), std::string::npos);
}

TEST(AvatarModel, of_3ds_takes_the_labels_that_lie_beside_it) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "me.3ds";
    fs::copy_file(kModels / "derived_kenney_character.3ds", file);
    const auto found = load_avatar_model(file);
    ASSERT_TRUE(found) << found.error().message;
    const auto head = motion::index_of(Bone::head);
    EXPECT_EQ(found->model.character.humanoid.nodes[head], -1);
    ASSERT_TRUE(write_file(folder / "me.labels.toml",
                           "format = \"raks-avatar-labels\"\nversion = 1\n[bones]\n"
                           "head = \"antenna\"\n"));
    const auto labelled = load_avatar_model(file);
    ASSERT_TRUE(labelled) << labelled.error().message;
    const int node = labelled->model.character.humanoid.nodes[head];
    ASSERT_GE(node, 0);
    EXPECT_EQ(labelled->model.nodes[static_cast<std::size_t>(node)].name, "antenna");
    EXPECT_EQ(labelled->model.character.humanoid.reasons[head], render::BoneReason::label);
}

}  // namespace
}  // namespace raks::engine
