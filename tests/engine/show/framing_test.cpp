// A film's camera keeps its dancers in the picture.
#include "engine/show/framing.hpp"
#include "engine/show/picture.hpp"

#include "motion/formation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

std::vector<motion::Pose> dancers_at(const std::vector<glm::vec3>& places) {
    std::vector<motion::Pose> poses;
    for (const glm::vec3& place : places) {
        motion::Pose pose;
        pose.hips_position = place;
        poses.push_back(pose);
    }
    return poses;
}

/// Where a place is in the picture: -1 to 1 from its left to its right edge.
float x_of(const render::Camera& camera, glm::vec3 place, float aspect) {
    const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(place, 1.0F);
    return clip.x / clip.w;
}

/// Both hands of spread arms, along the picture.
void expect_seen(const render::Camera& camera, const motion::Pose& pose, float aspect) {
    const glm::vec3 right(std::cos(camera.yaw), 0.0F, -std::sin(camera.yaw));
    for (const float arm : {-0.78F, 0.78F}) {
        const float x = x_of(camera, pose.hips_position + arm * right, aspect);
        EXPECT_LT(std::abs(x), 1.0F) << "arm " << arm << " in a picture of " << aspect;
    }
}

constexpr float kForms[] = {16.0F / 9.0F, 1.0F, 9.0F / 16.0F, 0.3F};

TEST(Framing, begins_at_the_middle_of_the_dancers_with_all_of_them_in_the_picture) {
    const auto couple = dancers_at({{0.3F, 0.95F, 0.2F}, {1.2F, 0.95F, -0.1F}});
    const auto three = dancers_at({{-1.3F, 0.95F, 0}, {0, 0.95F, 0}, {1.3F, 0.95F, 0}});
    for (const char* const name : {"wide", "portrait", "front", "side"}) {
        const render::Camera preset = render::find_camera(name).value();
        for (const float aspect : kForms) {
            for (const auto& poses : {couple, three}) {
                Framing framing(preset, aspect);
                const render::Camera camera = framing.follow(poses, 0.0);
                for (const motion::Pose& pose : poses) {
                    expect_seen(camera, pose, aspect);
                }
                const float left = x_of(camera, poses.front().hips_position, aspect);
                const float last = x_of(camera, poses.back().hips_position, aspect);
                EXPECT_NEAR(left, -last, 0.1F) << name << " " << aspect;
                EXPECT_EQ(camera.yaw, preset.yaw);
                EXPECT_EQ(camera.target.y, preset.target.y);
            }
        }
    }
}

TEST(Framing, shows_a_crowd_in_every_formation_and_form_of_picture) {
    for (const motion::Formation formation : {motion::Formation::unison,
                                              motion::Formation::free,
                                              motion::Formation::grid,
                                              motion::Formation::ring,
                                              motion::Formation::v}) {
        for (const std::size_t dancers : {std::size_t{12}, motion::kMostDancers}) {
            std::vector<glm::vec3> places;
            for (const glm::dvec2& place : motion::places_in(formation, dancers)) {
                places.emplace_back(place.x, 0.95F, place.y);
            }
            const auto poses = dancers_at(places);
            // A tall picture of 32 would show them smaller than anybody can see.
            for (const float aspect : {16.0F / 9.0F, 1.0F}) {
                Framing framing(render::find_camera("wide").value(), aspect);
                const render::Camera camera = framing.follow(poses, 0.0);
                for (const motion::Pose& pose : poses) {
                    expect_seen(camera, pose, aspect);
                }
            }
        }
    }
}

TEST(Framing, gives_a_large_figure_the_room_of_a_small_one_in_proportion) {
    constexpr float kSize = 1.4F;
    const render::Camera preset;
    const auto small = dancers_at({{-0.9F, 0.95F, 0}, {0.9F, 0.95F, 0}});
    const auto large =
        dancers_at({{-0.9F * kSize, 0.95F * kSize, 0}, {0.9F * kSize, 0.95F * kSize, 0}});
    for (const float aspect : kForms) {
        Framing one(preset, aspect);
        Framing other(camera_for(preset, kSize), aspect, kSize);
        const render::Camera near = one.follow(small, 0.0);
        const render::Camera far = other.follow(large, 0.0);
        if (far.distance < render::Camera::kMaxDistance) {
            EXPECT_NEAR(far.distance, kSize * near.distance, 1e-3F) << aspect;
        }
        EXPECT_NEAR(far.target.y, kSize * near.target.y, 1e-4F) << aspect;
    }
}

TEST(Framing, leaves_a_dancer_who_fits_as_near_as_the_preset) {
    const render::Camera preset;
    Framing framing(preset, 16.0F / 9.0F);
    EXPECT_NEAR(framing.follow(dancers_at({{0, 0.95F, 0}}), 0.0).distance, preset.distance, 1e-4F);
}

TEST(Framing, follows_without_a_jerk_and_does_not_lose_who_travels) {
    const float aspect = 9.0F / 16.0F;
    Framing framing(render::Camera(), aspect);
    render::Camera last = framing.follow(dancers_at({{0, 0.95F, 0}}), 0.0);
    constexpr double kStep = 1.0 / 30.0;
    for (int i = 1; i <= 150; ++i) {
        // Half a metre a second to the side and back: more than any dance travels.
        const float x = 0.5F * std::sin(0.033F * static_cast<float>(i));
        const auto poses = dancers_at({{x, 0.95F, 0}, {x + 0.5F, 0.95F, 0.4F}});
        const render::Camera camera = framing.follow(poses, kStep);
        EXPECT_LT(std::abs(camera.target.x - last.target.x), 0.03F) << i;
        EXPECT_LT(std::abs(camera.distance - last.distance), 0.3F) << i;
        if (i > 30) {
            for (const motion::Pose& pose : poses) {
                EXPECT_LT(std::abs(x_of(camera, pose.hips_position, aspect)), 0.75F) << i;
            }
        }
        last = camera;
    }
}

TEST(Framing, keeps_the_feet_of_who_comes_nearer_in_the_picture) {
    for (const char* const name : {"wide", "portrait", "front", "side"}) {
        const render::Camera preset = render::find_camera(name).value();
        const glm::vec3 toward(std::sin(preset.yaw), 0.0F, std::cos(preset.yaw));
        for (const float aspect : kForms) {
            Framing framing(preset, aspect);
            for (int i = 0; i <= 120; ++i) {
                // Two metres within two seconds, as fast as a walk, and then stays.
                const float way = std::clamp(static_cast<float>(i - 30) / 30.0F, 0.0F, 2.0F);
                const glm::vec3 hips = way * toward + glm::vec3(0.0F, 0.95F, 0.0F);
                const render::Camera camera = framing.follow(dancers_at({hips}), 1.0 / 30.0);
                const glm::vec3 foot = hips + 0.2F * toward - glm::vec3(0.0F, 0.95F, 0.0F);
                const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(foot, 1.0F);
                EXPECT_GT(clip.y / clip.w, -1.0F) << name << " " << aspect << " " << i;
            }
        }
    }
}

TEST(Framing, the_same_poses_give_the_same_cameras_and_none_move_it) {
    Framing one(render::Camera(), 1.0F);
    Framing other(render::Camera(), 1.0F);
    const auto poses = dancers_at({{0.4F, 0.9F, 0.1F}});
    EXPECT_EQ(one.follow({}, 1.0), render::Camera());
    EXPECT_EQ(other.follow({}, 1.0), render::Camera());
    EXPECT_EQ(one.follow(poses, 0.1), other.follow(poses, 0.1));
    EXPECT_EQ(one.follow({}, 5.0), other.follow({}, 0.0));
}

}  // namespace
}  // namespace raks::engine
