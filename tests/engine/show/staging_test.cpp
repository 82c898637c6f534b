// Camera and light of a show, hop by hop and picture by picture.
#include "engine/show/staging.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/scene/scene.hpp"

namespace raks::engine {
namespace {

/// One who walks to and fro, danced hop by hop.
class Stage {
 public:
    void dance(HopIndex hop) {
        motion::Pose pose;
        pose.hips_position = {0.5F * std::sin(0.01F * static_cast<float>(hop)), 0.95F, 0.0F};
        tracks.resize(1);
        tracks[0].append_final(hop, pose);
        music.hop = hop;
        music.time = time_of_hop(hop);
        music.part = MusicPart::playing;
        music.grid.confidence = 1.0F;
        music.accent = {};
        if (hop % 50 == 0) {
            music.accent.strength = 1.0F;
        }
    }
    MusicState music;
    std::vector<motion::PoseTrack> tracks;
};

TEST(Staging, a_moment_has_the_same_camera_and_light_however_often_one_looks) {
    Staging often(1, render::Liveliness::usual);
    Staging seldom(1, render::Liveliness::usual);
    Stage stage;
    for (HopIndex hop = 0; hop < 3000; ++hop) {
        stage.dance(hop);
        often.advance(stage.music, stage.tracks);
        seldom.advance(stage.music, stage.tracks);
        const StreamTime moment = time_of_hop(hop) - Nanos(33'300'000);
        render::Scene scene;
        often.set(scene, {}, {.time = moment}, stage.tracks);
        if (hop % 77 == 0) {
            render::Scene same;
            seldom.set(same, {}, {.time = moment}, stage.tracks);
            EXPECT_EQ(scene.camera, same.camera) << hop;
            EXPECT_EQ(scene.light, same.light) << hop;
        }
    }
}

TEST(Staging, lies_between_hops_and_never_between_two_shots) {
    Staging staging(1, render::Liveliness::usual);
    Stage stage;
    int cuts = 0;
    for (HopIndex hop = 0; hop < 6000; ++hop) {
        stage.dance(hop);
        staging.advance(stage.music, stage.tracks);
        if (hop < 2) {
            continue;
        }
        const auto before = staging.at(time_of_hop(hop - 1));
        const auto between = staging.at(time_of_hop(hop - 1) + kHop / 2);
        const auto after = staging.at(time_of_hop(hop));
        if (before.view.cuts != after.view.cuts) {
            EXPECT_EQ(between.view.camera, before.view.camera);
            ++cuts;
        } else {
            EXPECT_NEAR(between.view.camera.distance,
                        0.5F * (before.view.camera.distance + after.view.camera.distance),
                        1e-4F);
        }
    }
    EXPECT_GE(cuts, 3);
}

TEST(Staging, a_camera_that_is_held_stays_and_still_gets_light) {
    Staging staging(1, render::Liveliness::usual);
    Stage stage;
    for (HopIndex hop = 0; hop < 60; ++hop) {
        stage.dance(hop);
        staging.advance(stage.music, stage.tracks);
    }
    render::Scene scene;
    scene.camera.orbit(0.7F, 0.1F);
    const render::Camera held = scene.camera;
    staging.set(scene, {.is_held = true}, {.time = time_of_hop(59)}, stage.tracks);
    EXPECT_EQ(scene.camera, held);
    EXPECT_NE(scene.light, render::LightLevels{});
}

TEST(Staging, a_preset_keeps_its_angles_and_follows_who_travels) {
    Staging staging(1, render::Liveliness::usual);
    Stage stage;
    render::Scene scene;
    const render::Camera side = render::find_camera("side").value();
    for (HopIndex hop = 0; hop < 900; ++hop) {
        stage.dance(hop);
        staging.advance(stage.music, stage.tracks);
        staging.set(
            scene, {.name = "side", .preset = side}, {.time = stage.music.time}, stage.tracks);
        EXPECT_EQ(scene.camera.yaw, side.yaw);
        EXPECT_EQ(scene.camera.pitch, side.pitch);
        EXPECT_LT(
            std::abs(scene.camera.target.x - stage.tracks[0].at(stage.music.time).hips_position.x),
            0.7F);
    }
}

}  // namespace
}  // namespace raks::engine
