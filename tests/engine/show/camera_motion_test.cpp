// A camera's motion of MikuMikuDance as the camera of a film.
#include "engine/show/camera_motion.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/pending_file.hpp"
#include "tests/motion/skeleton/formats/vmd_maker.hpp"
#include "tests/support/temporary_folder.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace raks::engine {
namespace {

// Where a camera sees a place: x right, y up, -z ahead.
glm::dvec3 seen(const render::Camera& camera, const glm::dvec3& place) {
    return glm::dvec3(camera.view_from_world() * glm::vec4(glm::vec3(place), 1.0F));
}

TEST(CameraMotion, any_view_is_seen_as_it_is) {
    const glm::dvec3 place(0.3, 1.2, -0.4);
    for (const double yaw : {0.0, 0.7, 2.5, -3.0}) {
        for (const double pitch : {0.0, -0.4, 1.2, -2.0}) {
            for (const double roll : {0.0, 0.5, -2.8}) {
                for (const double distance : {3.6, 0.01, -2.0}) {
                    motion::MmdView view;
                    view.target = {0.1, 0.8, 0.2};
                    view.distance = distance;
                    view.turn = glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) *
                                glm::angleAxis(pitch, glm::dvec3(1, 0, 0)) *
                                glm::angleAxis(roll, glm::dvec3(0, 0, 1));
                    const glm::dvec3 truth = glm::conjugate(view.turn) * (place - view.eye());
                    EXPECT_LT(glm::length(seen(camera_of(view, 1.0F), place) - truth), 1e-4)
                        << yaw << " " << pitch << " " << roll << " " << distance;
                }
            }
        }
    }
}

TEST(CameraMotion, keys_are_read_and_cut_between_neighbouring_frames) {
    const test::TemporaryFolder folder;
    test::VmdMaker maker;
    // From the front and a little above: the file's figure faces -z, and the camera looks along +z.
    maker.count(0).count(0).count(3).camera(0, -45, {0, 10, 0}, {-0.2F, 0, 0}, 30);
    maker.camera(30, -25, {0, 10, 0}, {-0.2F, 0, 0}, 30);
    maker.camera(31, -25, {0, 10, 0}, {-0.2F, 1.5707963F, 0}, 60);
    ASSERT_TRUE(write_file(folder / "x.vmd", maker.bytes()));
    const auto motion = CameraMotion::load(folder / "x.vmd");
    ASSERT_TRUE(motion) << motion.error().message;
    const float size = 1.6F / 1.73F;  // of a body as tall as those of MikuMikuDance
    const render::Camera first = motion->at(0.0, size);
    EXPECT_NEAR(first.distance, 3.6F, 1e-4F);
    EXPECT_NEAR(first.yaw, 0.0F, 1e-5F);
    EXPECT_NEAR(first.pitch, 0.2F, 1e-5F);
    EXPECT_NEAR(first.target.y, 0.8F, 1e-4F);
    EXPECT_NEAR(first.vertical_fov, glm::radians(30.0F), 1e-5F);
    EXPECT_GT(first.position().z, 3.0F);
    EXPECT_NEAR(motion->at(0.5, size).distance, 2.8F, 1e-3F);  // half way on a straight line
    EXPECT_NEAR(motion->at(30.9 / 30.0).yaw, 0.0F, 1e-5F);
    // A quarter turn to the file's +x, which is the figure's left.
    EXPECT_NEAR(motion->at(31.0 / 30.0).yaw, glm::radians(90.0F), 1e-4F);
    EXPECT_GT(motion->at(60.0).position().x, 1.0F);
    // Times of pictures are rounded; the cut is at the file's frame all the same.
    EXPECT_NEAR(motion->at(31.0 / 30.0 - 1e-5).yaw, glm::radians(90.0F), 1e-4F);
    // Twice as large dancers, and the mannequin, whose middle is looked at as well.
    EXPECT_NEAR(motion->at(0.0, 2.0F * size).target.y, 1.6F, 1e-4F);
    EXPECT_NEAR(motion->at(0.0).target.y, 0.8F * 1.73F / 1.6F, 1e-4F);
}

TEST(CameraMotion, files_without_a_camera_are_refused) {
    const test::TemporaryFolder folder;
    test::VmdMaker maker;
    maker.count(1).bone(test::kVmdCenter, 0, {0, 0, 0});
    ASSERT_TRUE(write_file(folder / "x.vmd", maker.bytes()));
    const auto motion = CameraMotion::load(folder / "x.vmd");
    ASSERT_FALSE(motion);
    EXPECT_NE(motion.error().message.find("moves no camera, but a body; give it as --motion"),
              std::string::npos);
    ASSERT_TRUE(write_file(folder / "y.vmd", "HIERARCHY"));
    EXPECT_FALSE(CameraMotion::load(folder / "y.vmd"));
}

}  // namespace
}  // namespace raks::engine
