// What is drawn, without OpenGL: camera, themes, beat rings, shapes, lights.
#include <gtest/gtest.h>

#include "render/renderer.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/stage_light.hpp"
#include "render/scene/stage_shapes.hpp"
#include "render/scene/stick_figure.hpp"
#include "render/scene/theme.hpp"
#include "tests/render/scene/shipped_themes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <set>
#include <string>

namespace raks::render {
namespace {

constexpr float kAspect = 16.0F / 9.0F;
constexpr float kTolerance = 1e-5F;  // absolute; products of a few floats near 1

glm::vec3 ndc(const Camera& camera, glm::vec3 world, float aspect) {
    const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(world, 1.0F);
    return glm::vec3(clip) / clip.w;
}

TEST(Camera, target_is_in_the_middle_of_the_picture) {
    for (const std::string_view name : camera_names()) {
        const Camera camera = find_camera(name).value();
        for (const float aspect : {0.5F, 1.0F, kAspect}) {
            const glm::vec3 p = ndc(camera, camera.target, aspect);
            EXPECT_NEAR(p.x, 0.0F, kTolerance) << name;
            EXPECT_NEAR(p.y, 0.0F, kTolerance) << name;
        }
    }
}

TEST(Camera, right_of_the_picture_is_the_dancers_left_when_seen_from_the_front) {
    const Camera front = find_camera("front").value();
    EXPECT_GT(ndc(front, {0.3F, 0.86F, 0.0F}, kAspect).x, 0.1F);
    EXPECT_GT(ndc(front, {0.0F, 1.2F, 0.0F}, kAspect).y, 0.1F);
    const Camera back = find_camera("back").value();
    EXPECT_LT(ndc(back, {0.3F, 0.86F, 0.0F}, kAspect).x, -0.1F);
    const Camera side = find_camera("side").value();  // from the dancer's left: it faces left
    EXPECT_LT(ndc(side, {0.0F, 0.86F, 0.3F}, kAspect).x, -0.1F);
}

TEST(Camera, presets_show_the_whole_dancer) {
    for (const std::string_view name : camera_names()) {
        const Camera camera = find_camera(name).value();
        for (const glm::vec3 end : {glm::vec3(0.0F, 1.75F, 0.0F), glm::vec3(0.0F, 0.0F, 0.0F)}) {
            EXPECT_LT(std::abs(ndc(camera, end, kAspect).y), 1.0F) << name;
        }
    }
}

TEST(Camera, stays_at_its_distance_while_it_orbits) {
    Camera camera;
    for (int i = 0; i < 100; ++i) {
        camera.orbit(0.7F, 0.05F * static_cast<float>(i % 5 - 2));
        EXPECT_NEAR(glm::distance(camera.position(), camera.target), Camera{}.distance, 1e-4F);
        EXPECT_GE(camera.yaw, -3.1416F);
        EXPECT_LE(camera.yaw, 3.1416F);
    }
}

TEST(Camera, no_series_of_moves_leaves_the_limits) {
    Camera camera;
    const float huge = std::numeric_limits<float>::max();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float x : {-huge, -50.0F, -1e-9F, 0.0F, 0.3F, 1e3F, huge, nan, infinite}) {
        camera.orbit(x, x);
        camera.pan(x, -x);
        camera.zoom(x);
        EXPECT_GE(camera.pitch, Camera::kMinPitch);
        EXPECT_LE(camera.pitch, Camera::kMaxPitch);
        EXPECT_GE(camera.distance, Camera::kMinDistance);
        EXPECT_LE(camera.distance, Camera::kMaxDistance);
        EXPECT_LE(std::abs(camera.target.x), Camera::kMaxPan);
        EXPECT_LE(std::abs(camera.target.z), Camera::kMaxPan);
        EXPECT_GE(camera.target.y, 0.0F);
        EXPECT_LE(camera.target.y, Camera::kMaxTargetHeight);
        EXPECT_GT(camera.position().y, 0.0F) << "the camera is under the floor";
        EXPECT_TRUE(std::isfinite(camera.yaw));
    }
    camera.reset();
    EXPECT_EQ(camera, Camera{});
}

TEST(Camera, panning_moves_the_picture_and_not_the_depth) {
    Camera camera;
    camera.orbit(1.1F, 0.0F);
    const glm::vec3 before = ndc(camera, {0.0F, 1.0F, 0.0F}, kAspect);
    camera.pan(0.2F, 0.0F);
    const glm::vec3 after = ndc(camera, {0.0F, 1.0F, 0.0F}, kAspect);
    EXPECT_LT(after.x, before.x - 0.05F);
    EXPECT_NEAR(after.y, before.y, 1e-4F);
    EXPECT_NEAR(after.z, before.z, 1e-4F);
}

TEST(Camera, narrow_windows_keep_spread_arms_in_the_picture) {
    const Camera camera = find_camera("front").value();
    const glm::vec3 hand{0.7F, 0.86F, 0.0F};
    EXPECT_LT(ndc(camera, hand, 0.75F).x, 1.0F);
    EXPECT_NEAR(ndc(camera, hand, 0.4F).x, ndc(camera, hand, 0.75F).x, 1e-3F);
    EXPECT_EQ(camera.clip_from_view(0.8F)[1][1], camera.clip_from_view(kAspect)[1][1]);
}

TEST(Camera, an_unknown_name_is_answered_with_the_nearest_one) {
    EXPECT_EQ(find_camera("fornt").error().message,
              "camera \"fornt\" is unknown; did you mean \"front\"?");
}

TEST(Theme, colours_are_linear_and_lights_are_on) {
    for (const auto& [name, theme] : shipped_themes()) {
        for (const glm::vec3 colour : {theme.background_top, theme.floor_centre, theme.ring}) {
            for (int i = 0; i < 3; ++i) {
                EXPECT_GT(colour[i], 0.0F) << name;
                EXPECT_LE(colour[i], 1.0F) << name;
            }
        }
        EXPECT_GT(theme.key_light.g, theme.fill_light.g) << name;
        EXPECT_GT(theme.exposure, 0.0F) << name;
    }
}

BeatGrid grid_of(double bpm, int beats_per_bar, float confidence) {
    BeatGrid grid;
    grid.tempo = Bpm(bpm);
    grid.beats_per_bar = beats_per_bar;
    grid.confidence = confidence;
    return grid;
}

TEST(BeatRings, leave_on_the_beat_brighter_on_the_downbeat) {
    const BeatGrid grid = grid_of(120.0, 4, 1.0F);
    const auto at = [&](double beat) { return grid.time_of(Beats(beat)); };
    EXPECT_NEAR(beat_rings(grid, at(4.0))[0].brightness, 1.0F, 1e-3F);
    EXPECT_NEAR(beat_rings(grid, at(5.0))[0].brightness, 0.6F, 1e-3F);
    EXPECT_LT(beat_rings(grid, at(4.0))[0].radius, 0.31F);
}

TEST(BeatRings, grow_and_fade_until_nothing_is_left) {
    BeatRing before = beat_ring(0.0F, BeatAccent::downbeat);
    int drawn = 0;
    for (int step = 1; step < 100; ++step) {
        const float age = 0.05F * static_cast<float>(step);
        const BeatRing ring = beat_ring(age, BeatAccent::downbeat);
        EXPECT_LT(ring.brightness, std::max(before.brightness, 1e-9F)) << age;
        if (ring.brightness > 0.0F) {
            EXPECT_GT(ring.radius, before.radius) << age;
            ++drawn;
        }
        before = ring;
    }
    EXPECT_GT(drawn, 10);
    EXPECT_EQ(before.brightness, 0.0F);
    EXPECT_EQ(beat_ring(-0.1F, BeatAccent::beat).brightness, 0.0F);
    EXPECT_EQ(beat_ring(std::nanf(""), BeatAccent::beat).brightness, 0.0F);
}

TEST(BeatRings, are_dark_while_nothing_is_known) {
    for (const BeatRing& ring : beat_rings(grid_of(120.0, 4, 0.0F), StreamTime{})) {
        EXPECT_EQ(ring.brightness, 0.0F);
    }
}

TEST(BeatRings, keep_running_when_the_next_beat_sends_its_own) {
    const BeatGrid grid = grid_of(200.0, 3, 1.0F);
    const BeatRings before = beat_rings(grid, grid.time_of(Beats(5.999)));
    const BeatRings after = beat_rings(grid, grid.time_of(Beats(6.001)));
    EXPECT_NEAR(after[1].radius, before[0].radius, 0.01F);
    EXPECT_NEAR(after[1].brightness, before[0].brightness, 0.01F);
}

TEST(StageLight, key_light_follows_the_camera_by_six_tenths) {
    Camera camera;
    camera.yaw = 0.0F;
    const LightDirections still = light_directions(camera);
    camera.yaw = 1.0F;
    const LightDirections turned = light_directions(camera);
    const auto heading = [](glm::vec3 d) { return std::atan2(d.x, d.z); };
    EXPECT_NEAR(heading(turned.key) - heading(still.key), 0.6F, 1e-5F);
    EXPECT_NEAR(heading(turned.fill) - heading(still.fill), 1.0F, 1e-5F);
    EXPECT_NEAR(glm::length(turned.rim), 1.0F, 1e-5F);
}

TEST(StageLight, blobs_lie_away_from_the_key_light_and_weaken_with_height) {
    motion::Pose pose;
    pose.hips_position.y = motion::mannequin_skeleton().hips_height();
    const motion::WorldPose world = motion::world_pose(motion::mannequin_skeleton(), pose);
    const glm::vec3 key = light_directions(Camera{}).key;
    const auto blobs = shadow_blobs(world, 1.0F, key);
    const ShadowBlob& foot = blobs[0];
    const ShadowBlob& head = blobs[6];
    EXPECT_LT(glm::dot(glm::vec2(head.x, head.z), glm::vec2(key.x, key.z)), -0.5F);
    EXPECT_NEAR(foot.x, world.position(motion::Bone::left_foot).x, 0.1F);
    EXPECT_GT(head.radius, 0.15F);
    EXPECT_LT(head.strength, 0.65F);
    for (const ShadowBlob& blob : blobs) {
        EXPECT_GT(blob.radius, 0.0F);
        EXPECT_GT(blob.strength, 0.0F);
        EXPECT_LT(blob.strength, 1.0F);
    }
}

TEST(StageLight, shadow_map_holds_the_whole_dancer) {
    motion::Pose pose;  // T-pose: the widest
    pose.hips_position = {1.3F, motion::mannequin_skeleton().hips_height(), -0.8F};
    const motion::WorldPose world = motion::world_pose(motion::mannequin_skeleton(), pose);
    for (int i = 0; i < 12; ++i) {
        Camera camera;
        camera.orbit(0.5F * static_cast<float>(i), 0.0F);
        const glm::mat4 clip_from_world =
            light_clip_from_world(pose.hips_position, 0.0F, light_directions(camera).key);
        for (const glm::vec3& joint : world.positions) {
            const glm::vec4 clip = clip_from_world * glm::vec4(joint, 1.0F);
            EXPECT_LT(std::max({std::abs(clip.x), std::abs(clip.y), std::abs(clip.z)}), 1.0F);
        }
    }
}

template <typename Vertex>
void expect_indices_in_range(const Shape<Vertex>& shape) {
    ASSERT_FALSE(shape.indices.empty());
    EXPECT_EQ(shape.indices.size() % 3, 0U);
    EXPECT_LT(*std::max_element(shape.indices.begin(), shape.indices.end()), shape.vertices.size());
    EXPECT_LT(shape.vertices.size(), 65'536U);
}

TEST(StageShapes, indices_name_existing_vertices) {
    expect_indices_in_range(floor_disc());
    expect_indices_in_range(ring_strip());
    expect_indices_in_range(backdrop_grid());
    expect_indices_in_range(stick_figure(motion::mannequin_skeleton()));
}

TEST(StageShapes, backdrop_covers_the_picture_and_floor_its_disc) {
    const auto backdrop = backdrop_grid();
    EXPECT_EQ(backdrop.vertices.front(), glm::vec2(-1.0F, -1.0F));
    EXPECT_EQ(backdrop.vertices.back(), glm::vec2(1.0F, 1.0F));
    float widest = 0.0F;
    for (const glm::vec2 place : floor_disc().vertices) {
        widest = std::max(widest, glm::length(place));
    }
    EXPECT_NEAR(widest, kFloorRadius, 1e-4F);
}

TEST(StickFigure, every_triangle_faces_outward_as_its_normals_do) {
    const Shape<StickVertex> stick = stick_figure(motion::mannequin_skeleton());
    constexpr float kSliver = 1e-8F;  // square metres; rounding at the poles of a sphere
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < stick.indices.size(); i += 3) {
        const StickVertex& a = stick.vertices[stick.indices[i]];
        const StickVertex& b = stick.vertices[stick.indices[i + 1]];
        const StickVertex& c = stick.vertices[stick.indices[i + 2]];
        const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
        wrong += glm::dot(face, a.normal + b.normal + c.normal) < -kSliver ? 1U : 0U;
    }
    EXPECT_EQ(wrong, 0U);
}

TEST(StickFigure, colours_tell_left_from_right) {
    std::set<int> bones;
    for (const StickVertex& vertex : stick_figure(motion::mannequin_skeleton()).vertices) {
        const auto bone = static_cast<motion::Bone>(vertex.bone);
        bones.insert(vertex.bone);
        const bool is_left_colour = vertex.left > 0;
        const bool is_right_colour = vertex.right > 0;
        EXPECT_FALSE(is_left_colour && is_right_colour);
        if (bone == motion::Bone::left_lower_arm) {
            EXPECT_TRUE(is_left_colour);
        }
        if (bone == motion::Bone::right_lower_leg) {
            EXPECT_TRUE(is_right_colour);
        }
        if (bone == motion::Bone::head) {
            EXPECT_FALSE(is_left_colour || is_right_colour);
        }
    }
    EXPECT_EQ(bones.size(), static_cast<std::size_t>(motion::kBoneCount));
}

TEST(Quality, automatic_is_fast_on_software_drivers_only) {
    EXPECT_EQ(resolve_quality(Quality::automatic, "llvmpipe (LLVM 15.0.6, 256 bits)"),
              Quality::fast);
    EXPECT_EQ(resolve_quality(Quality::automatic, "softpipe"), Quality::fast);
    EXPECT_EQ(resolve_quality(Quality::automatic, "Mesa Intel(R) UHD Graphics 620 (KBL GT2)"),
              Quality::high);
    EXPECT_EQ(resolve_quality(Quality::high, "llvmpipe"), Quality::high);
    EXPECT_EQ(resolve_quality(Quality::fast, "NVIDIA GeForce"), Quality::fast);
}

}  // namespace
}  // namespace raks::render
