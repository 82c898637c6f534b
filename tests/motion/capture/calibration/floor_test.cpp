#include "motion/capture/calibration/floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/dice.hpp"
#include "motion/capture/camera/rotation.hpp"
#include "tests/motion/capture/calibration/studio.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

// The board on the floor, its middle at the origin, printed side up or down.
RigidMotion lying(const Board& board, bool is_up) {
    const glm::dvec3 middle(
        0.5 * board.square * board.columns, 0.5 * board.square * board.rows, 0.0);
    // x along x; z away from who looks at it from above is down.
    RigidMotion place{
        rotation_of({is_up ? 0.5 * 3.141592653589793 : -0.5 * 3.141592653589793, 0.0, 0.0}), {}};
    place.translation = -(place.rotation * middle);
    return place;
}

std::vector<Sighting> seen(const Rig& rig, const Board& board, const RigidMotion& place) {
    std::vector<Sighting> sightings;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
        Sighting sighting{camera, 0, {}};
        for (std::size_t i = 0; i < corner_count(board); ++i) {
            sighting.corners.push_back(
                {i, *project(rig.cameras[camera], place(glm::dvec3(corner_place(board, i), 0.0)))});
        }
        sightings.push_back(sighting);
    }
    return sightings;
}

// The same rig in a world that is turned and shifted.
Rig moved(const Rig& rig, const RigidMotion& motion) {
    Rig other = rig;
    for (Camera& camera : other.cameras) {
        set_pose(camera, pose_of(camera).after(motion.inverse()));
    }
    return other;
}

TEST(Floor, is_where_the_board_lay_with_all_cameras_above) {
    const test::Studio studio = test::make_studio({.poses = 0});
    const RigidMotion lost{rotation_of({1.0, -2.0, 0.5}), {3.0, -4.0, 5.0}};
    for (const bool is_up : {true, false}) {
        const auto sightings = seen(studio.rig, studio.board, lying(studio.board, is_up));
        // By all cameras, and by one alone, which cannot tell the poses apart by itself.
        for (const std::vector<Sighting>& some : {sightings, {sightings[3]}}) {
            Rig rig = moved(studio.rig, lost);
            const auto found = put_on_floor(rig, studio.board, some);
            ASSERT_TRUE(found) << found.error().message;
            for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
                EXPECT_LT(glm::distance(rig.cameras[i].centre(), studio.rig.cameras[i].centre()),
                          1e-5)
                    << i << (is_up ? " up" : " down");
            }
        }
    }
}

// The cameras stand 5 mm off and the corners tremble: one alone would be off by up to 13 mm.
TEST(Floor, is_where_all_cameras_together_say) {
    const test::Studio studio = test::make_studio({.poses = 0});
    double widest = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Dice dice(seed, 0);
        auto sightings = seen(studio.rig, studio.board, lying(studio.board, true));
        for (Sighting& sighting : sightings) {
            for (BoardCorner& corner : sighting.corners) {
                corner.pixel += glm::dvec2(dice.normal(0.3), dice.normal(0.3));
            }
        }
        Rig rig = studio.rig;
        for (Camera& camera : rig.cameras) {
            camera.translation +=
                glm::dvec3(dice.normal(0.005), dice.normal(0.005), dice.normal(0.005));
        }
        const Rig before = rig;
        ASSERT_TRUE(put_on_floor(rig, studio.board, sightings));
        const RigidMotion shift =
            pose_of(rig.cameras[0]).inverse().after(pose_of(before.cameras[0]));
        widest = std::max(widest, glm::length(shift.translation));
    }
    EXPECT_LT(widest, 0.011);
}

TEST(Floor, is_refused_where_a_camera_would_be_under_it) {
    const test::Studio studio = test::make_studio({.poses = 0});
    // Held upright between the cameras: some are before, some behind.
    RigidMotion upright = lying(studio.board, true);
    upright.rotation = glm::dmat3(1.0);
    Rig rig = studio.rig;
    const auto found = put_on_floor(rig, studio.board, seen(rig, studio.board, upright));
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("would be under the floor"), std::string::npos);
    const auto none = put_on_floor(rig, studio.board, {});
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("no camera saw the board"), std::string::npos);
}

}  // namespace
}  // namespace raks::capture
