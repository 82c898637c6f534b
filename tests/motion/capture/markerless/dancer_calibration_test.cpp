// Calibration by the dancer alone, and a body solved from what a network sees, against the truth.
#include "motion/capture/dancer_rig/dancer_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/markerless/keypoint_tracks.hpp"
#include "motion/capture/markerless/motion_sync.hpp"
#include "motion/capture/markerless/rough_clocks.hpp"
#include "motion/capture/solving/solve.hpp"
#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/motion_alignment.hpp"
#include "motion/evaluate/motion_comparison.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"
#include "tests/support/sanitized.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

std::vector<DancerCamera> dancer_cameras_of(const Rig& rig, bool are_lenses_known) {
    std::vector<DancerCamera> cameras;
    for (const Camera& camera : rig.cameras) {
        cameras.push_back({camera.name, camera.lens.width, camera.lens.height, std::nullopt});
        if (are_lenses_known) {
            cameras.back().lens = camera.lens;
        }
    }
    return cameras;
}

/// A scene and what is made of it.
struct DancerScene {
    test::SceneDance dance;
    Rig rig;
    std::vector<KeypointFilm> films;
    KeypointTake take;
};

DancerScene scene_of(const std::vector<double>& angles,
                     double focal,
                     double seconds,
                     test::NetworkErrors errors = {}) {
    DancerScene scene{
        test::written_dance("hiphop", 0, seconds), test::ring(angles, 4.3, focal), {}, {}};
    errors.pixels *= focal / 1559.0;
    const auto clocks = test::true_clocks(scene.rig);
    scene.films = test::filmed(scene.dance, scene.rig, clocks, errors);
    auto take = keypoint_take(scene.films, clocks, 30.0);
    EXPECT_TRUE(take) << take.error().message;
    scene.take = std::move(*take);
    return scene;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / M_PI;
}

// The world's up in a camera's own axes, against the true one; degrees.
double up_error(const Camera& found, const Camera& is) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    return degrees_between(found.rotation * up, is.rotation * up);
}

std::vector<double> errors_of(const KeypointTake& take) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < take.cameras; ++i) {
        errors.push_back(usual_error(take, i));
    }
    return errors;
}

TEST(DancerCalibration, two_cameras_and_a_height_give_the_dance) {
    if (raks::test::kIsSanitized) {
        GTEST_SKIP() << "it takes minutes under a sanitizer, which the next test is for";
    }
    const DancerScene scene = scene_of({0.0, 90.0}, 623.0, 12.0);
    const auto done =
        calibrate_by_dancer(scene.take, dancer_cameras_of(scene.rig, false), kMannequinHeight);
    ASSERT_TRUE(done) << done.error().message;
    ASSERT_EQ(done->pairs.size(), 1U);
    EXPECT_NEAR(done->pairs[0].angle, 90.0, 10.0);
    EXPECT_GT(done->pairs[0].agreeing, 0.9);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(up_error(done->rig.cameras[i], scene.rig.cameras[i]), 4.0);
    }
    const Tracks tracks = keypoint_tracks(done->rig, scene.take, errors_of(scene.take));
    SolveOptions options;
    options.height = kMannequinHeight;
    options.frames_per_second = 30.0;
    options.marker_deviation = 0.03;
    const auto solved = solve(tracks, keypoint_markers(), options);
    ASSERT_TRUE(solved) << solved.error().message;
    const auto is = motion::body_track(scene.dance.skeleton, scene.dance.poses, 60.0);
    auto got = motion::body_track(solved->skeleton, solved->poses, 30.0);
    const auto aligned = motion::align_motion(is, got);
    ASSERT_TRUE(aligned);
    EXPECT_NEAR(aligned->scale, 1.0, 0.05);
    EXPECT_LT(aligned->tilt, 4.0);
    EXPECT_LT(std::abs(aligned->move.y), 0.04);
    const auto left = motion::compare_motions(is, got);
    ASSERT_TRUE(left);
    EXPECT_LT(left->world, 0.06);
}

TEST(DancerCalibration, three_cameras_are_placed_jointly) {
    const DancerScene scene = scene_of({0.0, 80.0, 200.0}, 1559.0, 8.0);
    const auto done =
        calibrate_by_dancer(scene.take, dancer_cameras_of(scene.rig, true), kMannequinHeight);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(done->pairs.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(up_error(done->rig.cameras[i], scene.rig.cameras[i]), 4.0) << i;
        for (std::size_t j = i + 1; j < 3; ++j) {
            const double is =
                glm::distance(scene.rig.cameras[i].centre(), scene.rig.cameras[j].centre());
            const double found =
                glm::distance(done->rig.cameras[i].centre(), done->rig.cameras[j].centre());
            EXPECT_NEAR(found / is, 1.0, 0.1) << i << " " << j;
        }
    }
}

TEST(DancerCalibration, refuses_cameras_that_cannot_tell_distances) {
    struct Case {
        double angle;
        const char* said;
    };
    for (const Case& at :
         {Case{178.0, "stand opposite one another"}, Case{14.0, "stand side by side"}}) {
        const DancerScene scene = scene_of({0.0, at.angle}, 1559.0, 8.0);
        const auto done =
            calibrate_by_dancer(scene.take, dancer_cameras_of(scene.rig, true), kMannequinHeight);
        ASSERT_FALSE(done) << at.angle;
        EXPECT_NE(done.error().message.find(at.said), std::string::npos) << done.error().message;
        EXPECT_NE(done.error().message.find("70 to 100 degrees"), std::string::npos);
    }
}

TEST(DancerCalibration, says_whose_feet_are_not_seen) {
    DancerScene scene = scene_of({0.0, 90.0}, 1559.0, 2.0);
    for (std::size_t frame = 0; frame < scene.take.frame_count; ++frame) {
        for (const BodyPoint foot : {BodyPoint::left_ankle, BodyPoint::right_ankle}) {
            scene.take.at(frame, 1)[static_cast<std::size_t>(foot)] = {};
        }
    }
    const auto done =
        calibrate_by_dancer(scene.take, dancer_cameras_of(scene.rig, true), kMannequinHeight);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message,
              "camera2: no whole body is visible in it: nose and both ankles must be in view");
}

TEST(MotionSync, finds_clocks_of_a_dancers_films_from_nothing) {
    const auto dance = test::written_dance("hiphop", 0, 60.0);
    const Rig rig = test::ring({0.0, 90.0});
    auto clocks = test::true_clocks(rig);
    clocks[1].offset = -1.337;
    clocks[1].drift_ppm = 40.0;
    const auto films = test::filmed(dance, rig, clocks, {});
    const auto rough = rough_clocks(films, {10.0});
    ASSERT_TRUE(rough) << rough.error().message;
    EXPECT_NEAR(rough->clocks[1].offset, -1.337, 0.06);
    std::vector<MovingSights> sights;
    for (std::size_t i = 0; i < 2; ++i) {
        sights.emplace_back(films[i], rig.cameras[i].lens);
    }
    MotionSyncOptions options;
    options.error = 30.0;
    options.fits_drift = false;
    const auto found = sync_by_motion(rig, sights, rough->clocks, options);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->clocks[1].capture_time(clocks[1].camera_time(30.0)), 30.0, 0.017);
}

}  // namespace
}  // namespace raks::capture
