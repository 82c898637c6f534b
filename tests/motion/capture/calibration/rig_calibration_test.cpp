#include "motion/capture/calibration/rig_calibration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "motion/capture/triangulation/triangulation.hpp"
#include "tests/motion/capture/calibration/studio.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

std::vector<FilmedCamera> filmed(const test::Studio& studio) {
    std::vector<FilmedCamera> cameras;
    for (const Camera& camera : studio.rig.cameras) {
        cameras.push_back({camera.name, camera.lens.width, camera.lens.height, {}});
    }
    return cameras;
}

// Places where a dancer may be.
std::vector<glm::dvec3> stage() {
    std::vector<glm::dvec3> places;
    for (double x = -0.8; x <= 0.8; x += 0.4) {
        for (double y = 0.1; y <= 1.9; y += 0.45) {
            for (double z = -0.8; z <= 0.8; z += 0.4) {
                places.emplace_back(x, y, z);
            }
        }
    }
    return places;
}

// Where a rig sees places that the true one films without error.
std::vector<glm::dvec3> seen_at(const Rig& rig,
                                const Rig& truth,
                                const std::vector<glm::dvec3>& places) {
    std::vector<glm::dvec3> found;
    for (const glm::dvec3& place : places) {
        std::vector<PointView> views;
        for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
            const auto pixel = project(truth.cameras[i], place);
            views.push_back({.camera = i, .direction = direction_of(rig.cameras[i].lens, *pixel)});
        }
        found.push_back(triangulate_linear(rig, views).value_or(glm::dvec3{}));
    }
    return found;
}

double rms_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart = glm::distance(a[i], b[i]);
        sum += apart * apart;
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<glm::dvec3> centres(const Rig& rig) {
    std::vector<glm::dvec3> places;
    for (const Camera& camera : rig.cameras) {
        places.push_back(camera.centre());
    }
    return places;
}

TEST(RigCalibration, of_a_simulated_studio_is_true_to_millimetres) {
    for (const std::uint64_t seed : {1U, 3U}) {  // with 2 a pair shares 7 views: refused
        SCOPED_TRACE(seed);
        const test::Studio studio = test::make_studio({.seed = seed});
        const auto done = calibrate_rig(studio.board, filmed(studio), studio.sightings);
        ASSERT_TRUE(done) << done.error().message;
        const std::vector<glm::dvec3> places = stage();
        std::vector<glm::dvec3> seen = seen_at(done->rig, studio.rig, places);
        std::vector<glm::dvec3> stands = centres(done->rig);
        const RigidMotion onto = test::best_motion(seen, places);
        for (auto* const points : {&seen, &stands}) {
            std::transform(points->begin(), points->end(), points->begin(), onto);
        }
        const double points = rms_distance(seen, places);
        const double cameras = rms_distance(stands, centres(studio.rig));
        EXPECT_LT(points, 0.005);
        EXPECT_LT(cameras, 0.012);
        EXPECT_LT(done->held_out.reprojection, 0.25);
        EXPECT_LT(done->held_out.rms, 0.003);
        EXPECT_GT(done->held_out.edges, 500U);
        EXPECT_NEAR(done->rms, 0.3 * std::sqrt(2.0), 0.02);
        EXPECT_FALSE(done->has_floor);
        EXPECT_GT(done->rig.cameras[0].centre().y, 0.99);
        const std::string run = std::to_string(seed);
        RecordProperty("points_mm_" + run, std::to_string(points * 1e3));
        RecordProperty("centres_mm_" + run, std::to_string(cameras * 1e3));
        RecordProperty("edges_mm_" + run, std::to_string(done->held_out.rms * 1e3));
        RecordProperty("reprojection_" + run, std::to_string(done->held_out.reprojection));
    }
}

TEST(RigCalibration, is_the_same_bits_again_also_without_its_floor) {
    const test::Studio studio = test::make_studio({.seed = 3});
    const auto once = calibrate_rig(studio.board, filmed(studio), studio.sightings);
    // A board on the floor that no camera saw leaves the rig as it is, and says what it takes.
    const auto again = calibrate_rig(
        studio.board, filmed(studio), studio.sightings, {.floor_moment = std::size_t{100'000}});
    ASSERT_TRUE(once) << once.error().message;
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(once->rig, again->rig);
    EXPECT_EQ(again->rig.floor, FloorOrigin::unknown);
    EXPECT_FALSE(again->has_floor);
    const auto is_said = [&again](const char* words) {
        return std::any_of(again->doubts.begin(), again->doubts.end(), [words](const auto& doubt) {
            return doubt.find(words) != std::string::npos;
        });
    };
    EXPECT_TRUE(is_said("no camera saw the board on the floor"));
    EXPECT_TRUE(is_said("guessed from the feet"));
    EXPECT_TRUE(is_said("a square of 80 mm that lies in the middle is about "));
}

TEST(RigCalibration, is_refused_where_neighbours_share_too_little) {
    const test::Studio studio = test::make_studio({.poses = 25});
    const auto done = calibrate_rig(studio.board, filmed(studio), studio.sightings);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("film the board where both see it"), std::string::npos)
        << done.error().message;
}

TEST(RigCalibration, names_the_camera_that_never_saw_the_board) {
    test::Studio studio = test::make_studio({});
    std::erase_if(studio.sightings, [](const Sighting& one) { return one.camera == 2; });
    const auto done = calibrate_rig(studio.board, filmed(studio), studio.sightings);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("camera \"cam_2\" never saw the board"), std::string::npos)
        << done.error().message;
}

TEST(RigCalibration, doubts_films_that_are_not_in_sync) {
    test::Studio studio = test::make_studio({});
    for (Sighting& sighting : studio.sightings) {
        sighting.moment +=
            sighting.camera == 1 ? 6 : 0;  // the next board shown to the same cameras
    }
    const auto done = calibrate_rig(studio.board, filmed(studio), studio.sightings);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_TRUE(std::any_of(done->doubts.begin(), done->doubts.end(), [](const auto& doubt) {
        return doubt.find("\"cam_1\" is off by") != std::string::npos &&
               doubt.find("in sync") != std::string::npos;
    }));
}

}  // namespace
}  // namespace raks::capture
