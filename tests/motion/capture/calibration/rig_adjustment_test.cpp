#include "motion/capture/calibration/rig_adjustment.hpp"

#include <gtest/gtest.h>

#include <string>

#include "motion/capture/calibration/edge_errors.hpp"
#include "motion/capture/camera/rig_file.hpp"
#include "tests/motion/capture/calibration/studio.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::capture {
namespace {

// What others filmed and calibrated, and how well its boards are measured.
struct Reference {
    std::string folder;
    std::string table;
    std::size_t points;
    std::size_t edges;
    double before;        // RMS of edges; mm
    double reprojection;  // mean; px
    double goal;          // RMS of edges after adjustment; mm
};

TEST(RigAdjustment, of_real_cameras_measures_boards_better_than_their_own_calibration) {
    const Board board{.columns = 4, .rows = 5, .square = 0.054, .marker = 0.0405};
    const auto folder = raks::test::shared_data() / "capture/caliscope";
    for (const Reference& one :
         {Reference{"post_optimization", "xy_CHARUCO.csv", 660, 923, 0.821, 1.275, 0.74},
          Reference{"4_cam_recording", "xy.csv", 574, 811, 0.782, 0.609, 0.73}}) {
        const auto file = read_rig(folder / one.folder / "camera_array.toml");
        if (!file) {
            GTEST_SKIP() << "skipped: no rigs of Caliscope in ../shared";
        }
        SCOPED_TRACE(one.folder);
        const auto sightings = test::read_sightings(folder / one.folder / one.table);
        const EdgeErrors before = edge_errors(file->rig, board, sightings);
        EXPECT_EQ(before.points, one.points);
        EXPECT_EQ(before.edges, one.edges);
        EXPECT_NEAR(before.rms * 1e3, one.before, 0.005);
        EXPECT_NEAR(before.reprojection, one.reprojection, 0.005);
        Rig rig = file->rig;
        BoardPlaces places = place_boards(rig, board, sightings);
        const auto adjusted = adjust_rig(rig, places, board, sightings);
        ASSERT_TRUE(adjusted) << adjusted.error().message;
        const EdgeErrors after = edge_errors(rig, board, sightings);
        EXPECT_LT(after.rms * 1e3, one.goal);
        EXPECT_LT(after.reprojection, before.reprojection);
        RecordProperty("edges_" + one.folder, std::to_string(after.rms * 1e3));
        // With the lenses as they were there is little to gain.
        Rig fixed = file->rig;
        BoardPlaces others = place_boards(fixed, board, sightings);
        ASSERT_TRUE(adjust_rig(fixed, others, board, sightings, LensFreedom::fixed));
        EXPECT_EQ(fixed.cameras[2].lens, file->rig.cameras[2].lens);
        EXPECT_GT(edge_errors(fixed, board, sightings).rms, after.rms);
    }
}

TEST(RigAdjustment, leaves_a_true_rig_that_sees_without_error) {
    const test::Studio studio = test::make_studio({.poses = 20, .noise = 0.0});
    Rig rig = studio.rig;
    BoardPlaces places = place_boards(rig, studio.board, studio.sightings);
    const auto adjusted = adjust_rig(rig, places, studio.board, studio.sightings);
    ASSERT_TRUE(adjusted) << adjusted.error().message;
    EXPECT_LT(adjusted->rms, 1e-6);
    EXPECT_LT(edge_errors(rig, studio.board, studio.sightings).worst, 1e-7);
}

TEST(RigAdjustment, of_nothing_is_refused) {
    test::Studio studio = test::make_studio({.poses = 0});
    BoardPlaces places;
    EXPECT_FALSE(adjust_rig(studio.rig, places, studio.board, {}));
}

}  // namespace
}  // namespace raks::capture
