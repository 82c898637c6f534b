// What we write as VRMA, read by our own reader of models.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "motion/skeleton/formats/vrma.hpp"
#include "render/avatar/animation_sampler.hpp"
#include "render/import/model_reader.hpp"
#include "tests/render/avatar/tiny_model.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the tests' own small models
using motion::Bone;

// Two arms that move, hips that travel; all else rests.
std::vector<motion::Pose> some_poses(std::size_t count) {
    std::vector<motion::Pose> poses(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto t = static_cast<float>(i);
        poses[i].rotation(Bone::left_upper_arm) = turn_about_z(1.9F * std::sin(t));
        poses[i].rotation(Bone::right_lower_arm) = turn_about_y(0.3F * t);
        poses[i].hips_position = {0.01F * t, 0.9F - 0.02F * t, 0.0F};
    }
    return poses;
}

Model model_of(const std::vector<motion::Pose>& poses) {
    const auto bytes = motion::vrma_bytes(motion::mannequin_skeleton(), poses, 10.0, "some");
    EXPECT_TRUE(bytes) << bytes.error().message;
    auto model =
        read_model(std::as_bytes(std::span(bytes->data(), bytes->size())), "x.vrma", SideFiles());
    EXPECT_TRUE(model) << model.error().message;
    return std::move(*model);
}

TEST(VrmaRoundTrip, poses_come_back_as_they_were) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{9}}) {
        const std::vector<motion::Pose> poses = some_poses(count);
        const Model model = model_of(poses);
        EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
        ASSERT_EQ(model.animations.size(), 1U);
        EXPECT_EQ(model.animations[0].name, "some");
        const AnimationSampler sampler(model, 0);
        EXPECT_FLOAT_EQ(sampler.duration(), 0.1F * static_cast<float>(count - 1));
        EXPECT_TRUE(sampler.has_travel());
        EXPECT_LT(glm::distance(sampler.rest_hips(), motion::mannequin_skeleton().offsets[0]),
                  1e-6F);
        for (std::size_t i = 0; i < count; ++i) {
            const motion::Pose pose = sampler.pose_at(0.1F * static_cast<float>(i));
            EXPECT_LT(glm::distance(pose.hips_position, poses[i].hips_position), 1e-6F);
            for (std::size_t bone = 0; bone < pose.local_rotations.size(); ++bone) {
                EXPECT_TRUE(is_same_rotation(
                    pose.local_rotations[bone], poses[i].local_rotations[bone], 1e-3F))
                    << motion::kBoneNames[bone] << " of pose " << i;
            }
        }
    }
}

TEST(VrmaRoundTrip, faces_come_back_as_they_were) {
    const std::vector<motion::Pose> poses = some_poses(3);
    const std::vector<motion::ExpressionTrack> face = {
        {.name = "happy", .is_preset = true, .weights = {0.0F, 0.5F, 1.0F}},
        {.name = "browUpLeft", .is_preset = false, .weights = {0.25F, 0.25F, 0.25F}}};
    const auto bytes = motion::vrma_bytes(motion::mannequin_skeleton(), poses, 10.0, "x", face);
    ASSERT_TRUE(bytes) << bytes.error().message;
    const auto model =
        read_model(std::as_bytes(std::span(bytes->data(), bytes->size())), "x.vrma", SideFiles());
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    const AnimationSampler sampler(*model, 0);
    ASSERT_TRUE(sampler.has_face());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const Face shown = sampler.face_at(0.1F * static_cast<float>(i));
        EXPECT_NEAR(shown.weight(FaceExpression::happy), face[0].weights[i], 1e-6F);
        EXPECT_NEAR(shown.weight(FaceExpression::brow_up_left), 0.25F, 1e-6F);
        EXPECT_EQ(shown.weight(FaceExpression::angry), 0.0F);
    }
}

TEST(VrmaRoundTrip, what_cannot_be_written_is_said) {
    const motion::Skeleton& body = motion::mannequin_skeleton();
    std::vector<motion::Pose> poses = some_poses(2);
    EXPECT_EQ(motion::vrma_bytes(body, {}, 60.0, "x").error().message, "no poses to write");
    EXPECT_EQ(motion::vrma_bytes(body, poses, 0.0, "x").error().message,
              "0 poses a second, must be > 0");
    poses[1].hips_position.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(motion::vrma_bytes(body, poses, 60.0, "x").error().message, "pose 1 is not finite");
}

}  // namespace
}  // namespace raks::render
