// A world that no board told is put on its floor by the dancer's feet.
#include "motion/capture/tracking/feet_floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/dice.hpp"
#include "motion/capture/camera/rotation.hpp"
#include "motion/capture/studio/point_studio.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

constexpr double kRate = 30.0;

/// A dancer who stands here and there on the floor, and leans to a side all the time.
Tracks standing_about(const MarkerSet& markers) {
    const motion::Skeleton& body = motion::mannequin_skeleton();
    Tracks tracks;
    tracks.frames_per_second = kRate;
    for (const Marker& marker : markers.markers) {
        tracks.markers.push_back(marker.name);
    }
    const std::vector<glm::vec2> places = {
        {-0.7F, -0.5F}, {0.6F, -0.6F}, {0.8F, 0.5F}, {-0.6F, 0.7F}, {0.0F, 0.0F}};
    Dice dice(3, 0);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        for (int frame = 0; frame < 60; ++frame) {
            // A second here, a second on the way.
            const float way = std::clamp(static_cast<float>(frame - 30) / 30.0F, 0.0F, 1.0F);
            motion::Pose pose;
            pose.hips_position = {places[i].x + way * (places[i + 1].x - places[i].x),
                                  body.hips_height(),
                                  places[i].y + way * (places[i + 1].y - places[i].y)};
            pose.rotation(motion::Bone::spine) = glm::angleAxis(0.2F, glm::vec3(1.0F, 0.0F, 0.0F));
            for (const glm::dvec3& place :
                 marker_places(markers, body, motion::world_pose(body, pose))) {
                const glm::dvec3 off(dice.normal(0.004), dice.normal(0.004), dice.normal(0.004));
                tracks.places.push_back({place + off, 0.004, 3, PlaceSource::seen});
            }
            ++tracks.frame_count;
        }
    }
    return tracks;
}

TEST(FeetFloor, is_found_in_a_world_that_leans_and_hangs) {
    const MarkerSet markers = default_markers();
    const Tracks truth = standing_about(markers);
    const glm::dmat3 lean = rotation_of({0.25, -0.4, 0.15});
    const glm::dvec3 shift(0.4, -1.3, 2.0);
    Tracks lost = truth;
    for (MarkerPlace& place : lost.places) {
        place.place = lean * place.place + shift;
    }
    const auto levelling = level_by_feet(lost, markers, 0.0);
    ASSERT_TRUE(levelling);
    const glm::dvec3 up = levelling->rotation * (lean * glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_GT(up.y, std::cos(0.02));
    for (std::size_t i = 0; i < truth.places.size(); i += 37) {
        const double height =
            (levelling->rotation * lost.places[i].place + levelling->translation).y;
        EXPECT_NEAR(height, truth.places[i].place.y, 0.025);
    }
    // The cameras go with it: they see the same.
    Rig rig = studio_rig(3);
    for (Camera& camera : rig.cameras) {
        camera.rotation = camera.rotation * glm::transpose(lean);
        camera.translation -= camera.rotation * shift;
    }
    const Rig before = rig;
    level(rig, *levelling);
    EXPECT_EQ(rig.floor, FloorOrigin::feet);
    const glm::dvec3 place(0.3, -0.2, 2.5);
    const glm::dvec3 moved = levelling->rotation * place + levelling->translation;
    EXPECT_LT(glm::distance(rig.cameras[1].in_camera(moved), before.cameras[1].in_camera(place)),
              1e-9);
}

TEST(FeetFloor, is_not_guessed_without_feet) {
    const MarkerSet markers = default_markers();
    Tracks tracks = standing_about(markers);
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        for (std::size_t i = 0; i < tracks.markers.size(); ++i) {
            const std::string& name = tracks.markers[i];
            if (name.ends_with("toe") || name.ends_with("ankle")) {
                tracks.at(frame, i) = {};
            }
        }
    }
    EXPECT_FALSE(level_by_feet(tracks, markers, 0.0));
}

}  // namespace
}  // namespace raks::capture
