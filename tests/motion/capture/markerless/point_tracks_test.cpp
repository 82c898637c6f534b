// Anybody's points as tracks: names, units, axes and floors that files do not say; and C3D.
#include "motion/capture/markerless/point_tracks.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/markers/track_c3d.hpp"
#include "motion/capture/solving/solve.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "motion/evaluate/body_track.hpp"
#include "motion/evaluate/motion_alignment.hpp"
#include "motion/evaluate/motion_comparison.hpp"
#include "motion/skeleton/formats/points.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// Joints as another program has them: "l-wrist", millimetres, z up, somewhere in its room.
motion::PointClip foreign_points(const test::SceneDance& dance, double units_per_metre) {
    motion::PointClip clip;
    const MarkerSet markers = keypoint_markers();
    for (const Marker& marker : markers.markers) {
        std::string name = marker.name;
        if (name.substr(0, 5) == "left_") {
            name = "l-" + name.substr(5);
        } else if (name.substr(0, 6) == "right_") {
            name = "r-" + name.substr(6);
        }
        clip.names.push_back(name);
    }
    clip.names.emplace_back("T10");
    clip.frames_per_second = 60.0;
    for (const motion::Pose& pose : dance.poses) {
        for (const glm::dvec3& place :
             marker_places(markers, dance.skeleton, motion::world_pose(dance.skeleton, pose))) {
            clip.positions.push_back(units_per_metre *
                                     glm::dvec3(place.z + 1.0, place.x, place.y + 0.4));
        }
        clip.positions.emplace_back(0.0);
        ++clip.frame_count;
    }
    return clip;
}

TEST(PointTracks, joints_of_another_program_become_a_dance) {
    const auto dance = test::written_dance("rock", 0, 3.0);
    for (const double units : {1.0, 1000.0}) {
        const auto points = point_tracks(foreign_points(dance, units), {});
        ASSERT_TRUE(points) << points.error().message;
        EXPECT_GE(points->tracks.markers.size(), 19U);
        ASSERT_EQ(points->notes.size(), 2U);
        EXPECT_EQ(points->notes[0],
                  units == 1.0 ? "does not say its unit: taken as m"
                               : "does not say its unit: taken as mm");
        if (units == 1.0) {
            continue;
        }
        const auto solved = solve(points->tracks, points->markers);
        ASSERT_TRUE(solved) << solved.error().message;
        const auto is = motion::body_track(dance.skeleton, dance.poses, 60.0);
        auto got = motion::body_track(solved->skeleton, solved->poses, 60.0);
        const auto aligned = motion::align_motion(is, got);
        ASSERT_TRUE(aligned);
        EXPECT_LT(aligned->tilt, 1.0);
        EXPECT_LT(std::abs(aligned->move.y), 0.02);
        EXPECT_LT(motion::compare_motions(is, got)->world, 0.03);
    }
}

TEST(PointTracks, refuses_in_one_line_what_is_no_dancer) {
    const auto dance = test::written_dance("rock", 0, 0.5);
    motion::PointClip clip = foreign_points(dance, 1000.0);
    clip.metres_per_unit = 1.0;
    const auto huge = point_tracks(clip, {});
    ASSERT_FALSE(huge);
    EXPECT_EQ(huge.error().message.substr(0, 26), "its unit gives a dancer 15");
    EXPECT_NE(huge.error().message.find("m tall; --unit mm would make it 1.5"), std::string::npos)
        << huge.error().message;
    PointReading told;
    told.metres_per_unit = 0.001;
    EXPECT_TRUE(point_tracks(clip, told));
    for (std::size_t i = 0; i < clip.names.size(); ++i) {
        clip.names[i] = "M" + std::to_string(i);
    }
    const auto nameless = point_tracks(clip, told);
    ASSERT_FALSE(nameless);
    EXPECT_EQ(nameless.error().message,
              "its points (M0, M1, M2, M3, M4, M5, M6, M7, ...) are not called after joints, so "
              "nobody knows where on the body they are: tell the names by --names X.tsv, or where "
              "markers sit by --markers X.toml");
}

TEST(TrackC3d, reads_back) {
    Tracks tracks;
    tracks.markers = {"left_wrist", "head"};
    tracks.frames_per_second = 29.97;
    for (int frame = 0; frame < 70000; ++frame) {
        tracks.places.push_back({{0.001 * frame, 1.25, -2.5}, 0.01, 2, PlaceSource::seen});
        tracks.places.push_back({});
        ++tracks.frame_count;
    }
    const auto clip = motion::parse_c3d(c3d_bytes(tracks), "x.c3d", std::nullopt);
    ASSERT_TRUE(clip) << clip.error().message;
    EXPECT_EQ(clip->names, tracks.markers);
    EXPECT_EQ(clip->frame_count, 70000U);
    EXPECT_NEAR(clip->frames_per_second, 29.97, 1e-5);
    EXPECT_EQ(clip->metres_per_unit, 1.0);
    ASSERT_TRUE(clip->up);
    EXPECT_NEAR(clip->up->y, 1.0, 1e-9);
    EXPECT_NEAR(clip->position(69999, 0).x, 69.999, 1e-5);
    EXPECT_NEAR(clip->position(5, 0).z, -2.5, 1e-6);
    EXPECT_TRUE(std::isnan(clip->position(5, 1).x));
    EXPECT_TRUE(clip->warnings.empty()) << clip->warnings.front();
}

}  // namespace
}  // namespace raks::capture
