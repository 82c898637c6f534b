// What a network does wrong is found by views and time: sides exchanged, other people, nobody.
#include "motion/capture/markerless/keypoint_tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/markerless/motion_sync.hpp"
#include "motion/capture/markerless/side_exchange.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

struct NetworkScene {
    Rig rig;
    KeypointTake take;
    std::vector<double> errors;
};

NetworkScene network_scene(const test::NetworkErrors& errors, double seconds) {
    NetworkScene scene;
    scene.rig = test::ring({0.0, 90.0});
    const auto clocks = test::true_clocks(scene.rig);
    auto take = keypoint_take(
        test::filmed(test::written_dance("rock", 1, seconds), scene.rig, clocks, errors),
        clocks,
        30.0);
    EXPECT_TRUE(take) << take.error().message;
    scene.take = std::move(*take);
    for (std::size_t i = 0; i < 2; ++i) {
        scene.errors.push_back(usual_error(scene.take, i));
    }
    return scene;
}

void expect_alike_on_both_sides(const MarkerSet& set) {
    ASSERT_EQ(set.markers.size(), followed_points().size());
    for (std::size_t i = 0; i < set.markers.size(); ++i) {
        const BodyPoint point = followed_points()[i];
        EXPECT_EQ(set.markers[i].name, name_of(point));
        EXPECT_EQ(other_side(other_side(point)), point);
        const Marker& other = set.markers[*set.index_of(name_of(other_side(point)))];
        EXPECT_EQ(other.bone, motion::mirrored(set.markers[i].bone));
        EXPECT_NEAR(other.place.y, set.markers[i].place.y, 1e-6);
        if (point != BodyPoint::nose) {
            EXPECT_NEAR(other.place.x, -set.markers[i].place.x, 1e-6);
        }
    }
}

TEST(KeypointMarkers, are_alike_on_both_sides) {
    expect_alike_on_both_sides(keypoint_markers());
    expect_alike_on_both_sides(network_markers());
}

TEST(KeypointMarkers, of_networks_have_hips_lower_and_knees_behind_within_3_cm) {
    const MarkerSet joints = keypoint_markers();
    const MarkerSet seen = network_markers();
    for (std::size_t i = 0; i < joints.markers.size(); ++i) {
        EXPECT_LT(glm::distance(seen.markers[i].place, joints.markers[i].place), 0.03);
    }
    const auto moved = [&](BodyPoint point) {
        const std::size_t i = *joints.index_of(name_of(point));
        return seen.markers[i].place - joints.markers[i].place;
    };
    EXPECT_LT(moved(BodyPoint::right_hip).y, -0.005);
    EXPECT_LT(moved(BodyPoint::right_knee).z, -0.005);
}

TEST(SideExchange, finds_the_stretch_and_puts_it_right) {
    test::NetworkErrors errors;
    const NetworkScene is = network_scene(errors, 8.0);
    errors.exchanged = {{3.0, 4.0}};
    NetworkScene seen = network_scene(errors, 8.0);
    const auto found = put_sides_right(seen.rig, seen.errors, seen.take);
    std::set<ExchangedLimbs> limbs;
    std::size_t frames = 0;
    for (const SideExchange& stretch : found) {
        EXPECT_EQ(stretch.camera, 0U);
        EXPECT_GE(stretch.first, 87U);
        EXPECT_LE(stretch.last, 122U);
        limbs.insert(stretch.limbs);
        frames += stretch.last - stretch.first + 1;
    }
    EXPECT_EQ(limbs.size(), 2U);
    EXPECT_NEAR(static_cast<double>(frames), 60.0, 8.0);
    Tracks tracks = keypoint_tracks(seen.rig, seen.take, seen.errors);
    add_flags(found, {"left", "right"}, tracks);
    EXPECT_TRUE(std::any_of(tracks.flags.begin(), tracks.flags.end(), [&](const Flag& flag) {
        return flag.doubt == Doubt::exchanged && tracks.markers[flag.marker] == "left_ankle" &&
               flag.camera == "left";
    }));
    const auto lines = words_of(found, {"left", "right"}, tracks);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].substr(0, 37), "left: left and right were exchanged i");
    NetworkScene clean = is;
    EXPECT_TRUE(put_sides_right(clean.rig, clean.errors, clean.take).empty());
}

TEST(KeypointTracks, somebody_who_walks_by_is_not_followed) {
    test::NetworkErrors errors;
    errors.stranger = {{3.0, 4.5}};
    const NetworkScene scene = network_scene(errors, 8.0);
    const Tracks tracks = keypoint_tracks(scene.rig, scene.take, scene.errors);
    std::size_t lost = 0;
    for (std::size_t frame = 91; frame < 134; ++frame) {
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            lost += tracks.at(frame, marker).source == PlaceSource::lost ? 1U : 0U;
        }
    }
    EXPECT_EQ(lost, (134U - 91U) * tracks.markers.size());
    EXPECT_TRUE(std::any_of(tracks.flags.begin(), tracks.flags.end(), [](const Flag& flag) {
        return flag.doubt == Doubt::person && flag.first <= 92U && flag.last >= 130U;
    }));
    std::size_t seen = 0;
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        seen += tracks.at(200, marker).source == PlaceSource::seen ? 1U : 0U;
    }
    EXPECT_GT(seen, tracks.markers.size() * 2 / 3);
}

TEST(KeypointTake, needs_two_films_of_one_time_with_somebody_in_them) {
    const Rig rig = test::ring({0.0, 90.0});
    auto clocks = test::true_clocks(rig);
    auto films = test::filmed(test::written_dance("rock", 0, 2.0), rig, clocks, {});
    EXPECT_EQ(keypoint_take({films[0]}, {clocks[0]}, 30.0).error().message,
              "one camera is too few: a second one tells how far away things are");
    clocks[1].offset = 100.0;
    EXPECT_EQ(keypoint_take(films, clocks, 30.0).error().message,
              "the films share no second of time; are the clocks right (clocks.toml)?");
    clocks[1].offset = 0.0;
    for (KeypointPicture& picture : films[1].pictures) {
        picture.points = {};
    }
    EXPECT_EQ(keypoint_take(films, clocks, 30.0).error().message,
              "camera2: nobody is seen in its film; the dancer's whole body and feet must be in "
              "view");
}

TEST(MotionSync, of_markers_is_within_2_ms) {
    const auto dance = test::written_dance("rock", 0, 60.0);
    const Rig rig = studio_rig(3);
    StudioOptions options;
    options.clock_error = 0.05;
    options.drift_ppm = 40.0;
    options.first_clock_is_true = true;
    const StudioTake take =
        film_points({dance.skeleton, dance.poses, 60.0}, rig, default_markers(), options);
    std::vector<MovingSights> sights;
    std::vector<Clock> start;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        sights.emplace_back(take.seen.films[i], rig.cameras[i].lens);
        start.push_back({rig.cameras[i].name, 0.0, 0.0, 1.0});
    }
    const auto found = sync_by_motion(rig, sights, start);
    ASSERT_TRUE(found) << found.error().message;
    for (const double at : {5.0, 30.0, 55.0}) {
        for (std::size_t i = 1; i < rig.cameras.size(); ++i) {
            const double told = found->clocks[i].capture_time(take.clocks[i].camera_time(at));
            EXPECT_NEAR(told, at, 0.002) << i << " at " << at << " s";
        }
    }
}

TEST(MotionSync, finds_clocks_of_markers_that_are_seconds_off_and_names_a_repeat) {
    // The same four seconds again and again.
    constexpr std::size_t kPeriod = 240;  // frames
    auto dance = test::written_dance("waltz", 0, 15.0);
    for (std::size_t i = kPeriod; i < dance.poses.size(); ++i) {
        dance.poses[i] = dance.poses[i - kPeriod];
    }
    const Rig rig = studio_rig(2);
    StudioOptions options;
    options.first_clock_is_true = true;
    const StudioTake take =
        film_points({dance.skeleton, dance.poses, 60.0}, rig, default_markers(), options);
    std::vector<MovingSights> sights;
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
        sights.emplace_back(take.seen.films[i], rig.cameras[i].lens);
    }
    const std::vector<Clock> start = {{"camera1", 0.0}, {"camera2", 0.77}};
    MotionSyncOptions how;
    how.reach = 1.0;
    const auto near = sync_by_motion(rig, sights, start, how);
    ASSERT_TRUE(near) << near.error().message;
    EXPECT_NEAR(near->clocks[1].capture_time(7.5), 7.5, 0.003);
    EXPECT_TRUE(near->rivals.empty());
    how.reach = 6.0;
    const auto far = sync_by_motion(rig, sights, start, how);
    ASSERT_TRUE(far) << far.error().message;
    ASSERT_EQ(far->rivals.size(), 1U);
    // Whole repeats apart.
    EXPECT_NEAR(std::remainder(far->rivals[0].other - far->rivals[0].taken, 4.0), 0.0, 0.02);
}

TEST(MotionSync, says_where_nothing_moves) {
    const Rig rig = studio_rig(2);
    const SeenFilm empty{"a", {{0.0, {}}, {1.0, {}}, {2.0, {}}}};
    std::vector<MovingSights> sights;
    sights.emplace_back(empty, rig.cameras[0].lens);
    sights.emplace_back(empty, rig.cameras[1].lens);
    const auto found = sync_by_motion(rig, sights, {{"a"}, {"b"}});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().message,
              "nothing moves that two cameras see at once, so their clocks cannot be told from it");
}

}  // namespace
}  // namespace raks::capture
