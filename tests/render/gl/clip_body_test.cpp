#include "render/scene/clip_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "motion/skeleton/formats/bvh.hpp"
#include "render/mannequin/mannequin.hpp"
#include "render/pose_sheet.hpp"
#include "tests/render/gl/pictures.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::render {
namespace {

motion::MotionClip clip_of(const std::string& name) {
    const auto path =
        std::filesystem::path(RAKS_SOURCE_DIR) / "tests" / "data" / "bvh" / "odd" / name;
    auto clip = motion::read_bvh(path);
    EXPECT_TRUE(clip) << clip.error().message;
    return *clip;
}

/// A row of joints, each 0.1 m over the one before.
motion::MotionClip chain(std::size_t joints) {
    motion::MotionClip clip;
    clip.frames_per_second = 60.0;
    clip.frame_count = 1;
    for (std::size_t j = 0; j < joints; ++j) {
        clip.joints.push_back({"joint", j == 0 ? 0 : j - 1, {0.0, 0.1, 0.0}, std::nullopt});
        clip.rotations.emplace_back(1.0, 0.0, 0.0, 0.0);
        clip.positions.emplace_back(0.0, 0.1, 0.0);
    }
    return clip;
}

TEST(ClipBodies, stand_on_the_floor_in_the_middle_of_their_way) {
    const motion::MotionClip clip = clip_of("plain.bvh");  // 9 joints, centimetres
    const auto bodies = ClipBodies::create(clip, {.metres_per_unit = 0.01});
    ASSERT_TRUE(bodies) << bodies.error().message;
    float lowest = 1e9F;
    float highest = -1e9F;
    glm::vec3 low(1e9F);
    glm::vec3 high(-1e9F);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ClipBody body = bodies->at(frame);
        for (const StickVertex& vertex : body.shape.vertices) {
            lowest = std::min(lowest, vertex.position.y);
            highest = std::max(highest, vertex.position.y);
            EXPECT_NEAR(glm::length(vertex.normal), 1.0F, 1e-4F);
        }
        low = glm::min(low, body.landmarks.positions[0]);
        high = glm::max(high, body.landmarks.positions[0]);
    }
    EXPECT_NEAR(lowest, 0.0F, 0.05F) << "a twentieth of the frames may be lower";
    EXPECT_NEAR(highest, 1.4F, 0.2F);
    EXPECT_NEAR(low.x + high.x, 0.0F, 1e-4F);
    EXPECT_NEAR(low.z + high.z, 0.0F, 1e-4F);
    EXPECT_NEAR(bodies->size(), 1.4F / 1.714F, 0.1F);
}

TEST(ClipBodies, tell_left_from_right_and_know_a_head) {
    const motion::MotionClip clip = clip_of("plain.bvh");
    const ClipBody body = ClipBodies::create(clip, {.metres_per_unit = 0.01})->at(0);
    const auto colours = [&](auto wanted) {
        return std::count_if(body.shape.vertices.begin(), body.shape.vertices.end(), wanted);
    };
    EXPECT_GT(colours([](const StickVertex& v) { return v.left > 0; }), 100);
    EXPECT_EQ(colours([](const StickVertex& v) { return v.left > 0; }),
              colours([](const StickVertex& v) { return v.right > 0; }));
    motion::MotionClip headless = clip;
    for (motion::ClipJoint& joint : headless.joints) {
        joint.name = "joint";
    }
    EXPECT_GT(
        body.shape.vertices.size(),
        ClipBodies::create(headless, {.metres_per_unit = 0.01})->at(0).shape.vertices.size() + 400)
        << "the egg and the nose";
}

TEST(ClipBodies, of_many_joints_fit_one_mesh_or_are_refused) {
    const motion::MotionClip most = chain(ClipBodies::kMaxJoints);
    const auto bodies = ClipBodies::create(most, {.metres_per_unit = 1.0});
    ASSERT_TRUE(bodies);
    EXPECT_LT(bodies->at(0).shape.vertices.size(), 65'536U);
    const motion::MotionClip more = chain(ClipBodies::kMaxJoints + 1);
    const auto refused = ClipBodies::create(more, {.metres_per_unit = 1.0});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "has 201 joints; at most 200 can be drawn");
    EXPECT_FALSE(ClipBodies::create(motion::MotionClip{}));
}

TEST(ClipBodies, without_any_height_are_drawn_all_the_same) {
    motion::MotionClip flat = chain(1);
    const ClipBody body = ClipBodies::create(flat, {.metres_per_unit = 1.0})->at(0);
    ASSERT_FALSE(body.shape.vertices.empty());
    for (const StickVertex& vertex : body.shape.vertices) {
        EXPECT_TRUE(std::isfinite(vertex.position.x + vertex.position.y + vertex.position.z));
    }
}

/// Our own dance, its root turned as programs with z up write it.
motion::MotionClip dance_with_z_up() {
    motion::MotionClip clip = clip_of("../dance/own_dance.bvh");
    const glm::dquat turn =
        glm::angleAxis(glm::half_pi<double>(), glm::dvec3(1.0, 0.0, 0.0));  // y to z
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const std::size_t root = frame * clip.joints.size();
        clip.positions[root] = turn * clip.positions[root];
        clip.rotations[root] = turn * clip.rotations[root];
    }
    return clip;
}

TEST(ClipBodies, of_a_body_stand_whichever_axis_is_up) {
    const auto bodies = ClipBodies::create(dance_with_z_up());
    ASSERT_TRUE(bodies) << bodies.error().message;
    ASSERT_TRUE(bodies->body());
    EXPECT_NEAR(bodies->size(), 1.0F, 0.05F);
    const ClipBody body = bodies->at(0);
    const auto& places = body.landmarks;
    EXPECT_GT(places.position(motion::Bone::head).y, 1.2F) << "metres over the floor";
    EXPECT_LT(places.position(motion::Bone::left_foot).y, 0.3F);
    const glm::vec3 across = places.position(motion::Bone::left_upper_leg) -
                             places.position(motion::Bone::right_upper_leg);
    EXPECT_GT(across.x, 0.0F) << "faces us: its left is on our right";
}

TEST(ClipBodies, fit_the_picture_also_in_a_wrong_unit) {
    const auto bodies = ClipBodies::create(dance_with_z_up(), {.metres_per_unit = 1.0});
    ASSERT_TRUE(bodies) << bodies.error().message;
    EXPECT_LE(bodies->size(), 2.5F) << "a camera has to get back far enough";
    for (const StickVertex& vertex : bodies->at(0).shape.vertices) {
        EXPECT_LT(vertex.position.y, 2.5F * 1.9F);
    }
}

class ClipPicture : public OffscreenTest {};

TEST_F(ClipPicture, shows_the_body_where_the_avatar_would_be_and_the_avatar_again) {
    auto renderer = Renderer::create(build_mannequin(), {.quality = Quality::fast});
    ASSERT_TRUE(renderer) << renderer.error().message;
    const motion::MotionClip clip = clip_of("plain.bvh");
    const std::vector<ClipBody> bodies = {
        ClipBodies::create(clip, {.metres_per_unit = 0.01})->at(0)};
    const std::vector<motion::Pose> poses = {standing_pose()};
    PoseSheetConfig config;
    config.columns = 1;
    const auto before = draw_pose_sheet(*renderer, Scene{}, poses, config).value();
    const auto clip_sheet = draw_pose_sheet(*renderer, Scene{}, bodies, config).value();
    const auto after = draw_pose_sheet(*renderer, Scene{}, poses, config).value();
    EXPECT_EQ(clip_sheet.rgba.size(), before.rgba.size());
    EXPECT_TRUE(clip_sheet.rgba != before.rgba);
    EXPECT_TRUE(after.rgba == before.rgba) << "nothing of the body is left behind";
}

}  // namespace
}  // namespace raks::render
