#include "motion/capture/camera/calibrated_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/dice.hpp"
#include "motion/capture/camera/rig.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

const Lens kLens{640, 480, 600.0, 610.0, 322.0, 238.0, {-0.28, 0.09, 0.001, -0.0007, 0.01}};

Rig ring(int count) {
    Rig rig;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * i / count;
        rig.cameras.push_back(looking_at("cam" + std::to_string(i + 1),
                                         kLens,
                                         {4.0 * std::sin(angle), 1.6, 4.0 * std::cos(angle)},
                                         {0.0, 0.95, 0.0}));
    }
    return rig;
}

TEST(Camera, a_pixel_is_what_the_equations_of_opencv_say) {
    Camera camera;
    camera.lens = kLens;
    const auto pixel = project(camera, {0.3, -0.2, 2.0});
    ASSERT_TRUE(pixel);
    const double x = 0.15;
    const double y = -0.1;
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (-0.28 + r2 * (0.09 + r2 * 0.01));
    EXPECT_NEAR(pixel->x,
                322.0 + 600.0 * (x * radial + 0.001 * 2.0 * x * y - 0.0007 * (r2 + 2.0 * x * x)),
                1e-9);
    EXPECT_NEAR(pixel->y,
                238.0 + 610.0 * (y * radial + 0.001 * (r2 + 2.0 * y * y) - 0.0007 * 2.0 * x * y),
                1e-9);
}

TEST(Camera, pixels_and_directions_are_inverse) {
    for (int u = 0; u < kLens.width; u += 40) {
        for (int v = 0; v < kLens.height; v += 40) {
            const glm::dvec2 pixel(u, v);
            const glm::dvec2 back = distorted_pixel(kLens, direction_of(kLens, pixel));
            EXPECT_NEAR(back.x, pixel.x, 1e-5);
            EXPECT_NEAR(back.y, pixel.y, 1e-5);
        }
    }
}

TEST(Camera, looks_where_it_is_told) {
    const Camera camera = looking_at("a", kLens, {3.0, 2.0, 1.0}, {0.0, 1.0, 0.0});
    EXPECT_NEAR(glm::distance(camera.centre(), glm::dvec3(3.0, 2.0, 1.0)), 0.0, 1e-12);
    const auto middle = project(camera, {0.0, 1.0, 0.0});
    ASSERT_TRUE(middle);
    EXPECT_NEAR(middle->x, kLens.cx, 1e-9);
    EXPECT_NEAR(middle->y, kLens.cy, 1e-9);
    const auto above = project(camera, {0.0, 1.2, 0.0});
    ASSERT_TRUE(above);
    EXPECT_LT(above->y, middle->y);  // upright: y of a picture goes down
    EXPECT_FALSE(project(camera, {6.0, 3.0, 2.0}));
}

TEST(Camera, views_of_one_point_lie_on_epipolar_lines) {
    const Rig rig = ring(5);
    Dice dice(1, 0);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 point(dice.uniform(-1, 1), dice.uniform(0, 2), dice.uniform(-1, 1));
        const Camera& from = rig.cameras[static_cast<std::size_t>(dice.whole(0, 2))];
        const Camera& to = rig.cameras[3];
        const glm::dvec2 a = direction_of(from.lens, *project(from, point));
        const glm::dvec2 b = direction_of(to.lens, *project(to, point));
        EXPECT_LT(epipolar_distance(from, a, to, b), 1e-4);
        // Ten pixels to the side and ten down leave the line by ten together.
        const double across =
            epipolar_distance(from, a, to, b + glm::dvec2(10.0 / to.lens.fx, 0.0));
        const double down = epipolar_distance(from, a, to, b + glm::dvec2(0.0, 10.0 / to.lens.fy));
        EXPECT_NEAR(std::hypot(across, down), 10.0, 0.2);
    }
}

TEST(Camera, a_lens_that_folds_over_is_seen) {
    EXPECT_TRUE(std::isinf(folding_radius(kLens)));
    Lens folded = kLens;
    folded.distortion = {-2.0};
    // r (1 - 2 r^2) is greatest at r = 1 / sqrt(6), and 2 / 3 of that.
    EXPECT_NEAR(folding_radius(folded), kLens.fx * 2.0 / 3.0 / std::sqrt(6.0), 2.0);
    // It matters where something is seen beyond.
    Rig rig = ring(2);
    rig.cameras[1].lens = folded;
    const double radius = folding_radius(folded);
    EXPECT_TRUE(folding_doubts(rig, {1e6, radius - 1.0}).empty());
    ASSERT_EQ(folding_doubts(rig, {1e6, radius + 1.0}).size(), 1U);
    EXPECT_NE(folding_doubts(rig, {1e6, radius + 1.0})[0].find("folds over"), std::string::npos);
}

TEST(Rig, says_what_it_must_not_be) {
    EXPECT_TRUE(check_rig(ring(2)));
    EXPECT_FALSE(check_rig(ring(1)));
    Rig rig = ring(3);
    rig.cameras[2].name = rig.cameras[0].name;
    EXPECT_NE(check_rig(rig).error().message.find("two cameras"), std::string::npos);
    rig = ring(3);
    rig.cameras[1].rotation[0] = -rig.cameras[1].rotation[0];
    EXPECT_NE(check_rig(rig).error().message.find("mirror"), std::string::npos);
    rig = ring(3);
    rig.cameras[1].rotation[0] *= 1.01;
    EXPECT_NE(check_rig(rig).error().message.find("rotation is not one"), std::string::npos);
    rig = ring(3);
    rig.cameras[1].translation.x = std::nan("");
    EXPECT_NE(check_rig(rig).error().message.find("finite"), std::string::npos);
}

TEST(Rig, says_what_it_doubts) {
    EXPECT_TRUE(rig_doubts(ring(4)).empty());
    Rig rig = ring(2);
    for (Camera& camera : rig.cameras) {
        camera.translation *= 1000.0;
    }
    ASSERT_EQ(rig_doubts(rig).size(), 1U);
    EXPECT_NE(rig_doubts(rig)[0].find("millimetres"), std::string::npos);
    rig = ring(2);
    rig.cameras[0] = looking_at("low", kLens, {0.0, -1.0, 4.0}, {0.0, 1.0, 0.0});
    ASSERT_EQ(rig_doubts(rig).size(), 1U);
    EXPECT_NE(rig_doubts(rig)[0].find("under the floor"), std::string::npos);
}

}  // namespace
}  // namespace raks::capture
