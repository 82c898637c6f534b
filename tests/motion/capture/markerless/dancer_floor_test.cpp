// The vertical and the floor by a dancer who steps ahead and back on the spot, heels lifted behind.
#include "motion/capture/markerless/dancer_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "motion/capture/markerless/keypoint_markers.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// A dancer of 1.7 m in balance, one foot 0.3 m ahead and flat, the other as far behind on its
/// toes.
std::map<BodyPoint, glm::dvec3> step_ahead(bool is_left_ahead) {
    using Point = BodyPoint;
    std::map<BodyPoint, glm::dvec3> body;
    const auto both = [&body](Point left, glm::dvec3 place) {
        body[left] = place;
        body[other_side(left)] = {-place.x, place.y, place.z};
    };
    body[Point::nose] = {0.0, 1.55, 0.2};
    both(Point::left_ear, {0.08, 1.6, 0.05});
    both(Point::left_shoulder, {0.18, 1.4, 0.05});
    both(Point::left_elbow, {0.25, 1.15, 0.05});
    both(Point::left_wrist, {0.25, 0.9, 0.05});
    both(Point::left_hip, {0.1, 0.92, 0.05});
    both(Point::left_knee, {0.1, 0.5, 0.05});
    const auto put_foot = [&body](bool is_left, double ahead, double heel) {
        const double x = is_left ? 0.1 : -0.1;
        body[is_left ? Point::left_ankle : Point::right_ankle] = {x, 0.08 + heel, ahead};
        body[is_left ? Point::left_heel : Point::right_heel] = {x, 0.02 + heel, ahead - 0.05};
        body[is_left ? Point::left_foot_index : Point::right_foot_index] = {x, 0.02, ahead + 0.15};
    };
    put_foot(is_left_ahead, 0.3, 0.0);
    put_foot(!is_left_ahead, -0.3, 0.1);
    return body;
}

/// Steps of 0.4 s for so many seconds, 30 frames a second, by a dancer whose body over the feet is
/// so far ahead of where it would be in balance.
Tracks steps_for(double seconds, double ahead) {
    constexpr double kRate = 30.0;
    Tracks tracks;
    tracks.frames_per_second = kRate;
    tracks.frame_count = static_cast<std::size_t>(seconds * kRate);
    for (const BodyPoint point : followed_points()) {
        tracks.markers.emplace_back(name_of(point));
    }
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        auto body = step_ahead(frame / 12 % 2 == 0);
        for (auto& [point, place] : body) {
            place.z += place.y > 0.3 ? ahead : 0.0;
        }
        for (const BodyPoint point : followed_points()) {
            const bool is_placed = body.count(point) > 0;
            tracks.places.push_back({is_placed ? body[point] : glm::dvec3(0.0, 1.0, 0.0),
                                     0.01,
                                     2,
                                     is_placed ? PlaceSource::seen : PlaceSource::lost});
        }
    }
    return tracks;
}

struct UpScene {
    double seconds = 20.0;
    double ahead = 0.0;  // as of steps_for; metres
    double roll = 0.0;   // by which both cameras are turned about their axes; degrees
};

// Degrees between the world's up and the true one.
double up_off(const UpScene& scene) {
    Rig rig = test::ring({0.0, 90.0}, 4.0, 1000.0);
    for (Camera& camera : rig.cameras) {
        const double angle = scene.roll * M_PI / 180.0;
        const glm::dmat3 turn(glm::dvec3(std::cos(angle), std::sin(angle), 0.0),
                              glm::dvec3(-std::sin(angle), std::cos(angle), 0.0),
                              glm::dvec3(0.0, 0.0, 1.0));
        camera.rotation = turn * camera.rotation;
        camera.translation = turn * camera.translation;
    }
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const glm::dvec3 before = rig.cameras.front().rotation * up;
    const auto floor = put_on_dancers_floor(rig, steps_for(scene.seconds, scene.ahead), 1.7);
    EXPECT_TRUE(floor) << floor.error().message;
    const glm::dvec3 after = rig.cameras.front().rotation * up;
    return std::acos(std::min(1.0, glm::dot(before, after))) * 180.0 / M_PI;
}

// The cameras, which are turned, do not help.
TEST(DancerFloor, heels_that_are_lifted_behind_do_not_tilt_the_world) {
    EXPECT_LT(up_off({.seconds = 10.0, .roll = 90.0}), 1.0);
    EXPECT_LT(up_off({.seconds = 60.0, .roll = 90.0}), 1.0);
}

TEST(DancerFloor, level_cameras_hold_the_world_of_a_dancer_who_leans) {
    const UpScene leaning{.ahead = 0.1};  // 6 degrees, of which toes take a part back
    const UpScene turned{.ahead = 0.1, .roll = 90.0};
    EXPECT_LT(up_off(leaning), 0.75 * up_off(turned));
}

TEST(DancerFloor, cameras_that_are_turned_far_hardly_tilt_it) {
    EXPECT_LT(up_off({.roll = 3.0}), 2.5);
    EXPECT_LT(up_off({.roll = 30.0}), 1.0);
}

}  // namespace
}  // namespace raks::capture
