// Whole pictures of the mannequin and the stick figure, drawn off-screen by llvmpipe.
#include "tests/render/gl/pictures.hpp"
#include "tests/render/scene/shipped_themes.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/vec4.hpp>
#include <string>

#include "render/mannequin/mannequin.hpp"
#include "render/renderer.hpp"

namespace raks::render {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 180;

const Avatar& mannequin() {
    static const Avatar avatar = build_mannequin();
    return avatar;
}

class RendererTest : public OffscreenTest {
 protected:
    static Renderer make_renderer(Quality quality) {
        Expected<Renderer> renderer = Renderer::create(mannequin(), {.quality = quality});
        EXPECT_TRUE(renderer.has_value()) << (renderer ? "" : renderer.error().message);
        return std::move(renderer).value();
    }

    static Picture draw(Renderer& renderer,
                        const Scene& scene,
                        const motion::Pose& pose,
                        int width = kWidth,
                        int height = kHeight) {
        OffscreenTarget target = make_target(width, height, renderer.samples());
        renderer.draw(scene, pose, target.frame());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return read_picture(target);
    }
};

constexpr std::array<Quality, 2> kQualities = {Quality::fast, Quality::high};
constexpr std::array<View, 2> kViews = {View::skin, View::stick};

/// Arms hanging, a step to the left, the trunk turned.
motion::Pose step_pose() {
    motion::Pose pose = standing_pose();
    pose.rotation(motion::Bone::left_upper_arm) = glm::quat(glm::vec3(0.0F, 0.0F, -1.2F));
    pose.rotation(motion::Bone::right_upper_arm) = glm::quat(glm::vec3(0.0F, 0.0F, 1.2F));
    pose.rotation(motion::Bone::left_upper_leg) = glm::quat(glm::vec3(-0.3F, 0.0F, 0.2F));
    pose.rotation(motion::Bone::left_lower_leg) = glm::quat(glm::vec3(0.5F, 0.0F, 0.0F));
    pose.rotation(motion::Bone::spine) = glm::quat(glm::vec3(0.0F, 0.4F, 0.0F));
    return pose;
}

Scene transparent_scene(View view) {
    Scene scene;
    scene.view = view;
    scene.backdrop = Backdrop::transparent;
    return scene;
}

/// Column and row of a world point in a picture.
std::array<int, 2> pixel_of(const Camera& camera, glm::vec3 world) {
    const float aspect = static_cast<float>(kWidth) / static_cast<float>(kHeight);
    const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(world, 1.0F);
    return {static_cast<int>((0.5F + 0.5F * clip.x / clip.w) * kWidth),
            static_cast<int>((0.5F - 0.5F * clip.y / clip.w) * kHeight)};
}

TEST_F(RendererTest, body_is_where_the_skeleton_projects) {
    constexpr std::array<motion::Bone, 8> kInside = {motion::Bone::hips,
                                                     motion::Bone::chest,
                                                     motion::Bone::upper_chest,
                                                     motion::Bone::head,
                                                     motion::Bone::left_lower_arm,
                                                     motion::Bone::right_hand,
                                                     motion::Bone::left_lower_leg,
                                                     motion::Bone::right_foot};
    const motion::Pose pose = step_pose();
    const motion::WorldPose world = motion::world_pose(mannequin().skeleton, pose);
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        for (const View view : kViews) {
            Scene scene = transparent_scene(view);
            for (int turn = 0; turn < 4; ++turn) {
                scene.camera.orbit(1.3F, 0.05F);
                const Picture picture = draw(renderer, scene, pose);
                for (const motion::Bone bone : kInside) {
                    const auto [x, y] = pixel_of(scene.camera, world.position(bone));
                    EXPECT_GT(picture.pixel(x, y)[3], 250)
                        << motion::kBoneNames[motion::index_of(bone)] << " turn " << turn;
                }
            }
        }
    }
}

TEST_F(RendererTest, body_follows_the_hips_over_the_floor) {
    Renderer renderer = make_renderer(Quality::fast);
    const auto left_most = [](const Picture& picture) {
        for (int x = 0; x < picture.width; ++x) {
            for (int y = 0; y < picture.height / 2; ++y) {
                if (picture.pixel(x, y)[3] > 250) {
                    return x;
                }
            }
        }
        return picture.width;
    };
    const Scene scene = transparent_scene(View::skin);
    motion::Pose pose = step_pose();
    const int before = left_most(draw(renderer, scene, pose));
    pose.hips_position.x += 0.4F;
    const int after = left_most(draw(renderer, scene, pose));
    EXPECT_GT(after, before + 15);  // 0.4 m are 35 pixels at this size
    EXPECT_LT(after, before + 60);
}

TEST_F(RendererTest, transparent_backdrop_has_alpha_0_and_premultiplied_colours) {
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        Scene scene = transparent_scene(View::skin);
        scene.rings[0] = {.radius = 0.8F, .brightness = 0.7F};
        const Picture picture = draw(renderer, scene, step_pose());
        for (const auto& [x, y] : {std::pair{0, 0}, {kWidth - 1, 0}, {kWidth / 2, 2}}) {
            EXPECT_EQ(picture.pixel(x, y)[3], 0) << x << "," << y;
        }
        int shaded = 0;
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
            const int alpha = picture.rgba[i + 3];
            const int most = std::max({picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]});
            ASSERT_LE(most, alpha + 1) << "colour exceeds alpha: not premultiplied";
            shaded += alpha > 20 && alpha < 200 ? 1 : 0;
        }
        EXPECT_GT(shaded, 200) << "neither shadow nor ring on the floor";
    }
}

// A key that no dancer wears: a pixel with any of it in its mix would be purple or pink.
TEST_F(RendererTest, a_key_colour_is_everywhere_but_in_the_dancer_and_mixes_with_nothing) {
    constexpr KeyColour kMagenta = {255, 0, 255};
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        Scene scene;
        scene.rings[0] = {.radius = 0.8F, .brightness = 0.7F};
        scene.backdrop = Backdrop::transparent;
        scene.has_shadow = false;
        scene.has_rings = false;
        const Picture alone = draw(renderer, scene, step_pose());
        scene.backdrop = Backdrop::key;
        scene.key = kMagenta;
        scene.has_shadow = true;  // a key colour has neither, whatever is asked for
        scene.has_rings = true;
        const Picture keyed = draw(renderer, scene, step_pose());
        int dancer = 0;
        for (std::size_t i = 0; i < keyed.rgba.size(); i += 4) {
            const int alpha = alone.rgba[i + 3];
            ASSERT_EQ(keyed.rgba[i + 3], 255);
            for (std::size_t c = 0; c < 3; ++c) {
                const int wanted =
                    alpha < 128 ? kMagenta.at(c)
                                : std::min(255, (alone.rgba[i + c] * 255 + alpha / 2) / alpha);
                ASSERT_NEAR(keyed.rgba[i + c], wanted, alpha < 128 ? 0 : 1);
            }
            dancer += alpha >= 128 ? 1 : 0;
        }
        EXPECT_GT(dancer, 800);
    }
}

TEST_F(RendererTest, a_key_colour_stays_inside_its_part_of_the_target) {
    Renderer renderer = make_renderer(Quality::fast);
    OffscreenTarget target = make_target(64, 64);
    FrameTarget frame = target.frame();
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glClearColor(0.0F, 0.0F, 1.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    frame.x = 16;
    frame.width = 48;
    frame.part = PixelBox{32, 0, 32, 64};
    Scene scene;
    scene.backdrop = Backdrop::key;
    renderer.draw(scene, step_pose(), frame);
    const Picture picture = read_picture(target);
    EXPECT_EQ(picture.pixel(31, 2)[2], 255);
    EXPECT_EQ(picture.pixel(33, 2)[1], 255);
    EXPECT_EQ(picture.pixel(33, 2)[2], 0);
}

TEST_F(RendererTest, shadow_and_rings_can_be_left_out) {
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        Scene scene = transparent_scene(View::skin);
        scene.rings[0] = {.radius = 0.8F, .brightness = 0.7F};
        const auto covered = [&](bool has_shadow, bool has_rings) {
            scene.has_shadow = has_shadow;
            scene.has_rings = has_rings;
            const Picture picture = draw(renderer, scene, step_pose());
            int pixels = 0;
            for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
                pixels += picture.rgba[i] > 8 ? 1 : 0;
            }
            return pixels;
        };
        const int bare = covered(false, false);
        EXPECT_GT(covered(true, false), bare + 100);
        EXPECT_GT(covered(false, true), bare + 100);
    }
}

TEST_F(RendererTest, stage_is_opaque_everywhere_and_not_one_colour) {
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        for (const auto& [theme, look] : shipped_themes()) {
            Scene scene;
            scene.theme = &look;
            const Picture picture = draw(renderer, scene, step_pose());
            int opaque = 0;
            for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
                opaque += picture.rgba[i] == 255 ? 1 : 0;
            }
            EXPECT_EQ(opaque, kWidth * kHeight) << theme;
            if (look.is_listed) {
                EXPECT_EQ(picture.brightness() > 128.0, theme == "studio_light") << theme;
            }
        }
    }
}

TEST_F(RendererTest, the_same_pose_gives_the_same_pixels) {
    for (const Quality quality : kQualities) {
        Renderer first = make_renderer(quality);
        Renderer second = make_renderer(quality);
        for (const View view : kViews) {
            Scene scene;
            scene.view = view;
            const Picture picture = draw(first, scene, step_pose());
            draw(first, scene, standing_pose());  // what was drawn between leaves no trace
            EXPECT_EQ(picture.rgba, draw(first, scene, step_pose()).rgba);
            EXPECT_EQ(picture.rgba, draw(second, scene, step_pose()).rgba);
            EXPECT_NE(picture.rgba, draw(first, scene, standing_pose()).rgba);
        }
    }
}

TEST_F(RendererTest, a_beat_lights_the_floor_and_a_downbeat_more) {
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        Scene scene;
        const double dark = draw(renderer, scene, step_pose()).brightness();
        scene.rings[0] = beat_ring(0.15F, BeatAccent::beat);
        const double beat = draw(renderer, scene, step_pose()).brightness();
        scene.rings[0] = beat_ring(0.15F, BeatAccent::downbeat);
        const double downbeat = draw(renderer, scene, step_pose()).brightness();
        EXPECT_GT(beat, dark + 0.05);
        EXPECT_GT(downbeat, beat + 0.02);
    }
}

TEST_F(RendererTest, the_dancer_darkens_the_floor_beside_it) {
    for (const Quality quality : kQualities) {
        Renderer renderer = make_renderer(quality);
        const Scene scene;
        const Picture with = draw(renderer, scene, step_pose());
        motion::Pose elsewhere = step_pose();
        elsewhere.hips_position.x = 50.0F;
        const Picture without = draw(renderer, scene, elsewhere);
        // Behind the dancer, away from the key light, where only its shadow falls.
        const glm::vec3 chest = motion::world_pose(mannequin().skeleton, step_pose())
                                    .position(motion::Bone::upper_chest);
        const auto [x, y] =
            pixel_of(scene.camera, {chest.x + 0.45F * chest.y, 0.0F, chest.z - 0.85F * chest.y});
        int darkest = 255;
        for (int dx = -25; dx <= 25; ++dx) {
            for (int dy = -8; dy <= 8; ++dy) {
                const int change = with.pixel(x + dx, y + dy)[2] - without.pixel(x + dx, y + dy)[2];
                darkest = std::min(darkest, change);
            }
        }
        EXPECT_LT(darkest, -6);
    }
}

TEST_F(RendererTest, the_floor_mirrors_the_dancer_and_nothing_else_does) {
    Renderer renderer = make_renderer(Quality::high);
    Scene scene;
    motion::Pose elsewhere = step_pose();
    elsewhere.hips_position.x = 50.0F;
    // In red: the suit's image raises it, its shadow does not.
    const auto largest_rise_in_rows = [&](int from, int to) {
        const Picture with = draw(renderer, scene, step_pose());
        const Picture without = draw(renderer, scene, elsewhere);
        int largest = 0;
        for (int y = from; y < to; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                largest = std::max(largest, with.pixel(x, y)[0] - without.pixel(x, y)[0]);
            }
        }
        return largest;
    };
    scene.camera.zoom(1.5F);
    const int below_feet = pixel_of(scene.camera, {0.0F, 0.0F, 0.4F})[1];
    EXPECT_GT(largest_rise_in_rows(below_feet, kHeight), 5);

    // From far away and low the mirrored head would hang below the edge of the floor.
    scene.camera.distance = Camera::kMaxDistance;
    scene.camera.pitch = Camera::kMinPitch;
    scene.camera.yaw = 0.0F;
    const int floor_edge = pixel_of(scene.camera, {0.0F, 0.0F, 4.6F})[1];
    ASSERT_LT(floor_edge, kHeight - 10);
    EXPECT_EQ(largest_rise_in_rows(floor_edge + 1, kHeight), 0);
}

TEST_F(RendererTest, any_size_can_follow_any_other) {
    Renderer renderer = make_renderer(Quality::fast);
    const Scene scene;
    for (const auto& [width, height] :
         {std::pair{640, 360}, {1, 1}, {3, 400}, {400, 3}, {127, 61}, {640, 360}}) {
        const Picture picture = draw(renderer, scene, step_pose(), width, height);
        EXPECT_GT(picture.brightness(), 5.0) << width << "x" << height;
    }
}

TEST_F(RendererTest, a_target_without_area_draws_nothing) {
    Renderer renderer = make_renderer(Quality::fast);
    OffscreenTarget target = make_target(8, 8);
    FrameTarget frame = target.frame();
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glClearColor(0.0F, 1.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    frame.width = 0;  // a minimized window
    renderer.draw(Scene{}, step_pose(), frame);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(read_picture(target).pixel(4, 4)[1], 255);
}

TEST_F(RendererTest, a_rectangle_of_the_target_leaves_the_rest_alone) {
    Renderer renderer = make_renderer(Quality::fast);
    OffscreenTarget target = make_target(64, 64);
    FrameTarget frame = target.frame();
    glBindFramebuffer(GL_FRAMEBUFFER, frame.framebuffer);
    glClearColor(0.0F, 1.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    frame.x = 32;
    frame.width = 32;
    renderer.draw(Scene{}, step_pose(), frame);
    const Picture picture = read_picture(target);
    EXPECT_EQ(picture.pixel(31, 10)[1], 255);
    EXPECT_LT(picture.pixel(32, 10)[1], 128);
}

TEST_F(RendererTest, poses_that_are_not_numbers_do_not_harm) {
    Renderer renderer = make_renderer(Quality::fast);
    motion::Pose pose = step_pose();
    pose.hips_position.x = std::nanf("");
    pose.rotation(motion::Bone::spine) = glm::quat(0.0F, 0.0F, 0.0F, 0.0F);
    const Picture picture = draw(renderer, Scene{}, pose);
    EXPECT_EQ(picture.pixel(0, 0)[3], 255);
    EXPECT_EQ(draw(renderer, Scene{}, step_pose()).rgba, draw(renderer, Scene{}, step_pose()).rgba);
}

TEST_F(RendererTest, fifty_renderers_leave_no_object_behind) {
    const auto objects = [] {
        int count = 0;
        for (GLuint name = 1; name < 4000; ++name) {
            count += glIsBuffer(name) + glIsTexture(name) + glIsVertexArray(name) +
                     glIsProgram(name) + glIsShader(name) + glIsFramebuffer(name) +
                     glIsRenderbuffer(name);
        }
        return count;
    };
    const int before = objects();
    for (int i = 0; i < 50; ++i) {
        Renderer renderer = make_renderer(i % 10 == 0 ? Quality::high : Quality::fast);
        draw(renderer, Scene{}, step_pose(), 16, 16);
    }
    EXPECT_EQ(objects(), before);
}

TEST_F(RendererTest, software_driver_is_said_once_and_only_when_not_asked_for) {
    Renderer automatic = make_renderer(Quality::automatic);
    EXPECT_EQ(automatic.quality(), Quality::fast);
    EXPECT_EQ(automatic.samples(), 1);
    EXPECT_NE(automatic.notice().find("llvmpipe"), std::string_view::npos);
    EXPECT_TRUE(make_renderer(Quality::fast).notice().empty());
    Renderer high = make_renderer(Quality::high);
    EXPECT_TRUE(high.notice().empty());
    EXPECT_EQ(high.samples(), 4);
}

TEST_F(RendererTest, state_that_others_draw_with_is_handed_back) {
    Renderer renderer = make_renderer(Quality::high);
    OffscreenTarget target = make_target(32, 32, 4);
    renderer.draw(Scene{}, step_pose(), target.frame());
    constexpr std::array<GLenum, 5> kCapabilities = {
        GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_POLYGON_OFFSET_FILL};
    for (const GLenum capability : kCapabilities) {
        EXPECT_EQ(glIsEnabled(capability), GL_FALSE) << capability;
    }
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    EXPECT_EQ(static_cast<std::uint32_t>(bound), target.frame().framebuffer);
}

}  // namespace
}  // namespace raks::render
