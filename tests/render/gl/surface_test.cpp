// Textured and toon surfaces of imported avatars against their own formulas, on a sphere under the
// theme of one white light.
#include "tests/render/gl/pictures.hpp"
#include "tests/render/scene/shipped_themes.hpp"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <optional>

#include "render/avatar/model_avatar.hpp"
#include "render/renderer.hpp"
#include "render/scene/stage_light.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace raks::render {
namespace {

constexpr int kSide = 240;
const glm::vec3 kSphereMiddle{0.0F, 0.9F, 0.0F};
constexpr float kRadius = 0.5F;

/// A sphere of one material; u runs round it, v from the top down.
Model sphere_model(const ModelMaterial& material) {
    ModelPrimitive sphere;
    sphere.material = 0;
    constexpr std::uint32_t kRings = 64;
    constexpr std::uint32_t kSegments = 128;
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        for (std::uint32_t segment = 0; segment <= kSegments; ++segment) {
            const float u = static_cast<float>(segment) / kSegments;
            const float v = static_cast<float>(ring) / kRings;
            const float around = 2.0F * std::numbers::pi_v<float> * u;
            const float down = std::numbers::pi_v<float> * v;
            sphere.normals.emplace_back(std::sin(down) * std::sin(around),
                                        std::cos(down),
                                        std::sin(down) * std::cos(around));
            sphere.positions.push_back(kSphereMiddle + kRadius * sphere.normals.back());
            sphere.uv[0].emplace_back(u, v);
        }
    }
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
        for (std::uint32_t segment = 0; segment < kSegments; ++segment) {
            const std::uint32_t a = ring * (kSegments + 1) + segment;
            const std::uint32_t b = a + kSegments + 1;
            for (const std::uint32_t i : {a, b, a + 1, a + 1, b, b + 1}) {
                sphere.indices.push_back(i);
            }
        }
    }
    Model model;
    model.nodes.emplace_back().mesh = 0;
    model.roots = {0};
    model.materials.push_back(material);
    model.meshes.emplace_back().primitives = {sphere};
    return model;
}

Avatar sphere(const ModelMaterial& material) { return build_avatar(sphere_model(material), {}); }

Scene plain_scene() {
    Scene scene;
    scene.theme = &shipped_theme("plain");
    scene.camera.yaw = 0.0F;
    scene.camera.target = kSphereMiddle;
    scene.camera.distance = 3.0F;
    return scene;
}

/// The sphere's normal under the middle of a pixel; none beside it.
std::optional<glm::vec3> normal_at(const Camera& camera, int column, int row) {
    const glm::mat4 world_from_clip = glm::inverse(camera.clip_from_world(1.0F));
    const float x = (static_cast<float>(column) + 0.5F) / kSide * 2.0F - 1.0F;
    const float y = 1.0F - (static_cast<float>(row) + 0.5F) / kSide * 2.0F;
    const glm::vec4 far = world_from_clip * glm::vec4(x, y, 1.0F, 1.0F);
    const glm::vec3 from = camera.position();
    const glm::vec3 along = glm::normalize(glm::vec3(far) / far.w - from);
    const float b = glm::dot(along, from - kSphereMiddle);
    const float c = glm::dot(from - kSphereMiddle, from - kSphereMiddle) - kRadius * kRadius;
    if (b * b < c) {
        return std::nullopt;
    }
    return (from + (-b - std::sqrt(b * b - c)) * along - kSphereMiddle) / kRadius;
}

glm::vec3 shown(glm::vec3 linear) {
    const auto one = [](float x) {
        x = std::clamp(x, 0.0F, 1.0F);
        return 255.0F * (x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F);
    };
    return {one(linear.r), one(linear.g), one(linear.b)};
}

class SurfaceTest : public OffscreenTest {
 protected:
    static Picture draw(const Avatar& avatar, const Scene& scene, Quality quality) {
        Expected<Renderer> renderer = Renderer::create(avatar, {.quality = quality});
        EXPECT_TRUE(renderer.has_value()) << (renderer ? "" : renderer.error().message);
        OffscreenTarget target = make_target(kSide, kSide, 1);
        renderer->draw(scene, standing_pose(), target.frame());
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return read_picture(target);
    }

    /// Largest difference from `truth` of the normal, over the sphere but for its edge.
    static float farthest(const Picture& picture,
                          const Camera& camera,
                          const std::function<glm::vec3(glm::vec3)>& truth) {
        float most = 0.0F;
        for (int row = 0; row < kSide; ++row) {
            for (int column = 0; column < kSide; ++column) {
                const auto n = normal_at(camera, column, row);
                if (n && glm::dot(*n, glm::normalize(camera.position() - kSphereMiddle)) > 0.4F) {
                    const auto pixel = picture.at(column, row);
                    const glm::vec3 seen(pixel[0], pixel[1], pixel[2]);
                    const glm::vec3 off = glm::abs(seen - shown(truth(*n)));
                    most = std::max({most, off.r, off.g, off.b});
                }
            }
        }
        return most;
    }
};

TEST_F(SurfaceTest, an_unlit_surface_shows_its_colour) {
    ModelMaterial material;
    material.base_colour = {0.2F, 0.5F, 0.8F, 1.0F};
    material.is_unlit = true;
    for (const Quality quality : {Quality::fast, Quality::high}) {
        const Scene scene = plain_scene();
        const Picture picture = draw(sphere(material), scene, quality);
        EXPECT_LE(
            farthest(
                picture, scene.camera, [&](glm::vec3) { return glm::vec3(material.base_colour); }),
            1.0F);
    }
}

// VRMC_materials_mtoon-1.0: the linear step between shade and base colour, and the rim.
TEST_F(SurfaceTest, toon_steps_and_rims_follow_their_formula) {
    for (const auto& [shift, toony] : {std::pair{0.0F, 0.9F}, {-0.2F, 0.5F}, {0.3F, 0.0F}}) {
        ModelMaterial material;
        material.base_colour = {0.9F, 0.6F, 0.4F, 1.0F};
        material.mtoon = MToon{};
        material.mtoon->shade_colour = {0.3F, 0.1F, 0.2F};
        material.mtoon->shading_shift = shift;
        material.mtoon->shading_toony = toony;
        material.mtoon->rim_colour = {0.2F, 0.2F, 0.4F};
        material.mtoon->rim_fresnel_power = 3.0F;
        material.mtoon->rim_lift = 0.1F;
        material.mtoon->rim_lighting_mix = 0.0F;
        const Scene scene = plain_scene();
        const glm::vec3 key = light_directions(scene.camera).key;
        const auto truth = [&](glm::vec3 n) {
            const float s = glm::dot(n, key) + shift;
            const float lit =
                std::clamp((s - (-1 + toony)) / ((1 - toony) - (-1 + toony)), 0.0F, 1.0F);
            const glm::vec3 v =
                glm::normalize(scene.camera.position() - kSphereMiddle - kRadius * n);
            const float edge = std::clamp(1.0F - glm::dot(n, v) + 0.1F, 0.0F, 1.0F);
            return glm::mix(material.mtoon->shade_colour, glm::vec3(material.base_colour), lit) +
                   material.mtoon->rim_colour * std::pow(edge, 3.0F);
        };
        EXPECT_LE(farthest(draw(sphere(material), scene, Quality::high), scene.camera, truth), 2.0F)
            << shift << " " << toony;
        // Light by the vertex: as good between the steps, a little off where they are steep.
        EXPECT_LE(farthest(draw(sphere(material), scene, Quality::fast), scene.camera, truth), 8.0F)
            << shift << " " << toony;
    }
}

// In both qualities, in `fast` by light that is brought into the surface's own axes.
TEST_F(SurfaceTest, a_normal_map_turns_the_surface_against_the_light) {
    ModelMaterial material;
    material.base_colour = glm::vec4(1.0F);
    material.mtoon = MToon{};
    material.mtoon->shading_toony = 0.0F;
    material.normal_texture.texture = 0;
    Model model = sphere_model(material);
    model.textures.push_back({.image = 0, .is_smooth = false, .has_mipmaps = false});
    model.images.emplace_back();
    const glm::vec3 tilt(195.0F / 255.0F * 2.0F - 1.0F, 0.0F, 218.0F / 255.0F * 2.0F - 1.0F);
    const Avatar avatar = build_avatar(model, {{1, 1, {195, 128, 218, 255}}});
    const Scene scene = plain_scene();
    const glm::vec3 key = light_directions(scene.camera).key;
    const auto truth = [&](glm::vec3 n) {
        const glm::vec3 along = glm::normalize(glm::vec3(n.z, 0.0F, -n.x));
        const glm::vec3 turned = glm::normalize(along * tilt.x + n * tilt.z);
        return glm::vec3(std::clamp((glm::dot(turned, key) + 1.0F) / 2.0F, 0.0F, 1.0F));
    };
    EXPECT_LE(farthest(draw(avatar, scene, Quality::high), scene.camera, truth), 3.0F);
    // Between black and white a square root differs from sRGB by up to 9.
    EXPECT_LE(farthest(draw(avatar, scene, Quality::fast), scene.camera, truth), 12.0F);
}

// What the material has not by itself: no rim, no glow.
TEST_F(SurfaceTest, an_expression_colours_what_the_material_is_black_in) {
    for (const ColourBindKind kind : {ColourBindKind::rim,
                                      ColourBindKind::emission,
                                      ColourBindKind::shade,
                                      ColourBindKind::outline}) {
        ModelMaterial material;
        material.base_colour = {0.0F, 0.0F, 0.0F, 1.0F};
        material.mtoon = MToon{};
        material.mtoon->rim_fresnel_power = 0.5F;
        material.mtoon->outline_mode = OutlineWidth::world;
        material.mtoon->outline_width = 0.05F;
        material.mtoon->outline_lighting_mix = 0.0F;
        Model model = sphere_model(material);
        Expression& expression = model.character.expressions.emplace_back();
        expression.name = "glow";
        expression.colours.push_back(
            {.material = 0, .kind = kind, .target = {0.0F, 1.0F, 0.0F, 1.0F}});
        const Avatar avatar = build_avatar(model, {});
        for (const Quality quality : {Quality::fast, Quality::high}) {
            Expected<Renderer> renderer = Renderer::create(avatar, {.quality = quality});
            ASSERT_TRUE(renderer.has_value());
            OffscreenTarget target = make_target(kSide, kSide, 1);
            RigState state(*avatar.rig);
            const Dancer dancer{.avatar = {}, .pose = standing_pose(), .state = &state};
            Scene scene = plain_scene();
            scene.backdrop = Backdrop::transparent;
            const auto green = [&](float weight) {
                avatar.rig->expressions.apply(std::array{weight}, state.face);
                renderer->draw(scene, std::span(&dancer, 1), target.frame());
                const Picture picture = read_picture(target);
                int most = 0;
                for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
                    most = std::max(most, picture.rgba[i + 1] - picture.rgba[i]);
                }
                return most;
            };
            EXPECT_LT(green(0.0F), 30) << static_cast<int>(kind);
            EXPECT_GT(green(1.0F), 100) << static_cast<int>(kind);
        }
    }
}

TEST_F(SurfaceTest, a_texture_lies_where_its_coordinates_say) {
    ModelMaterial material;
    material.is_unlit = true;
    material.base_texture.texture = 0;
    Model model = sphere_model(material);
    model.textures.push_back({.image = 0, .is_smooth = false, .has_mipmaps = false});
    model.images.emplace_back();
    // Red above, green below.
    const Avatar avatar = build_avatar(model, {{1, 2, {255, 0, 0, 255, 0, 255, 0, 255}}});
    for (const Quality quality : {Quality::fast, Quality::high}) {
        const Picture picture = draw(avatar, plain_scene(), quality);
        EXPECT_EQ(picture.at(kSide / 2, kSide / 2 - 40)[0], 255);
        EXPECT_EQ(picture.at(kSide / 2, kSide / 2 - 40)[1], 0);
        EXPECT_EQ(picture.at(kSide / 2, kSide / 2 + 40)[0], 0);
        EXPECT_EQ(picture.at(kSide / 2, kSide / 2 + 40)[1], 255);
    }
}

TEST_F(SurfaceTest, what_the_mask_cuts_off_and_what_glass_lets_through) {
    ModelMaterial material;
    material.is_unlit = true;
    material.base_colour = {1.0F, 0.0F, 0.0F, 0.4F};
    Scene scene = plain_scene();
    scene.backdrop = Backdrop::transparent;
    for (const Quality quality : {Quality::fast, Quality::high}) {
        material.alpha_mode = AlphaMode::opaque;
        EXPECT_EQ(draw(sphere(material), scene, quality).at(kSide / 2, kSide / 2)[3], 255);
        material.alpha_mode = AlphaMode::mask;
        EXPECT_LT(draw(sphere(material), scene, quality).at(kSide / 2, kSide / 2)[3], 255);
        material.alpha_mode = AlphaMode::blend;
        const auto pixel = draw(sphere(material), scene, quality).at(kSide / 2, kSide / 2);
        EXPECT_NEAR(pixel[0], 0.4 * 255, 1.0);
    }
}

// The black edge is as wide as the material says; screenCoordinates: of the picture's height.
TEST_F(SurfaceTest, outlines_are_as_wide_as_they_say) {
    for (const OutlineWidth mode : {OutlineWidth::world, OutlineWidth::screen}) {
        ModelMaterial material;
        material.mtoon = MToon{};
        material.mtoon->shade_colour = glm::vec3(1.0F);
        material.mtoon->outline_mode = mode;
        const float pixels_a_metre = [&] {
            const glm::mat4 clip = plain_scene().camera.clip_from_view(1.0F);
            return clip[1][1] * 0.5F * kSide / 3.0F;
        }();
        material.mtoon->outline_width =
            mode == OutlineWidth::screen ? 6.0F / kSide : 6.0F / pixels_a_metre;
        material.mtoon->outline_lighting_mix = 0.0F;
        for (const Quality quality : {Quality::fast, Quality::high}) {
            const Picture picture = draw(sphere(material), plain_scene(), quality);
            int black = 0;
            for (int column = 0; column < kSide / 2; ++column) {
                const auto pixel = picture.at(column, kSide / 2);
                black += pixel[0] < 60 && pixel[1] < 60 && pixel[2] < 60 ? 1 : 0;
            }
            EXPECT_NEAR(black, 6, 1) << static_cast<int>(mode) << static_cast<int>(quality);
        }
    }
}

TEST_F(SurfaceTest, morph_targets_move_their_vertices_and_back) {
    ModelMaterial material;
    material.is_unlit = true;
    Model model = sphere_model(material);
    MorphTarget& away = model.meshes[0].primitives[0].morphs.emplace_back();
    for (std::uint32_t i = 0; i < model.meshes[0].primitives[0].positions.size(); ++i) {
        away.vertices.push_back(i);
        away.positions.emplace_back(0.0F, -5.0F, 0.0F);
    }
    model.meshes[0].morph_names = {"away"};
    model.meshes[0].morph_weights = {0.0F};
    const Avatar avatar = build_avatar(model, {});
    Expected<Renderer> renderer = Renderer::create(avatar, {.quality = Quality::fast});
    ASSERT_TRUE(renderer.has_value());
    OffscreenTarget target = make_target(kSide, kSide, 1);
    RigState state(*avatar.rig);
    const Dancer dancer{.avatar = {}, .pose = standing_pose(), .state = &state};
    const auto middle = [&](float weight) {
        state.face.morphs.at(0) = weight;
        renderer->draw(plain_scene(), std::span(&dancer, 1), target.frame());
        return read_picture(target).at(kSide / 2, kSide / 2)[0];
    };
    EXPECT_EQ(middle(0.0F), 255);
    EXPECT_LT(middle(1.0F), 255);
    EXPECT_EQ(middle(0.0F), 255);
}

/// Pixels of many colours, more than one piece of an upload.
Image large_image() {
    Image image{.width = 1024, .height = 700, .pixels = {}};
    for (std::size_t i = 0; i < std::size_t{1024} * 700; ++i) {
        for (const std::size_t byte : {i / 1024, i % 1024, i / 7, std::size_t{255}}) {
            image.pixels.push_back(static_cast<std::uint8_t>(byte));
        }
    }
    return image;
}

TEST_F(SurfaceTest, an_avatar_that_is_taken_in_pieces_looks_as_one_taken_at_once) {
    ModelMaterial material;
    material.is_unlit = true;
    material.base_texture.texture = 0;
    Model model = sphere_model(material);
    model.textures.push_back({.image = 0});
    const auto avatar = std::make_shared<const Avatar>(build_avatar(model, {large_image()}));
    const Picture whole = draw(*avatar, plain_scene(), Quality::fast);
    ModelMaterial plain;
    plain.is_unlit = true;
    Expected<Renderer> renderer = Renderer::create(sphere(plain), {.quality = Quality::fast});
    ASSERT_TRUE(renderer.has_value());
    OffscreenTarget target = make_target(kSide, kSide, 1);
    renderer->draw(plain_scene(), standing_pose(), target.frame());
    const Picture before = read_picture(target);
    renderer->begin_adding(avatar);
    std::optional<AvatarHandle> handle;
    int pictures = 0;
    for (; !handle && pictures < 100; ++pictures) {
        const auto added = renderer->add_pieces(Nanos(1));
        ASSERT_TRUE(added) << added.error().message;
        handle = *added;
        renderer->draw(plain_scene(), standing_pose(), target.frame());
        EXPECT_EQ(read_picture(target).rgba, before.rgba) << "the one before, untouched";
    }
    ASSERT_TRUE(handle);
    EXPECT_GT(pictures, 5);
    const Dancer dancer{.avatar = *handle, .pose = standing_pose(), .state = nullptr};
    renderer->draw(plain_scene(), std::span(&dancer, 1), target.frame());
    EXPECT_EQ(read_picture(target).rgba, whole.rgba);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(SurfaceTest, images_are_freed_once_the_driver_has_them_and_come_back_for_another_one) {
    ModelMaterial material;
    material.is_unlit = true;
    material.base_texture.texture = 0;
    Model model = sphere_model(material);
    model.textures.push_back({.image = 0});
    int unpacked = 0;
    const auto images = std::make_shared<SurfaceImages>(std::vector<Image>{large_image()}, [&] {
        ++unpacked;
        return std::vector<Image>{large_image()};
    });
    const Avatar avatar = build_avatar_with(images, model, {});
    const std::weak_ptr<const std::vector<Image>> pixels = images->get();
    const Picture first = draw(avatar, plain_scene(), Quality::fast);
    EXPECT_TRUE(pixels.expired());
    EXPECT_EQ(unpacked, 0);
    EXPECT_EQ(draw(avatar, plain_scene(), Quality::fast).rgba, first.rgba);
    EXPECT_EQ(unpacked, 1);
}

TEST_F(SurfaceTest, avatars_come_and_go_by_their_handles) {
    ModelMaterial material;
    material.is_unlit = true;
    const Avatar avatar = sphere(material);
    Expected<Renderer> renderer = Renderer::create(RendererConfig{.quality = Quality::fast});
    ASSERT_TRUE(renderer.has_value());
    const AvatarHandle first = renderer->add(avatar).value();
    const AvatarHandle second = renderer->add(avatar).value();
    EXPECT_NE(first.number, second.number);
    renderer->remove(first);
    EXPECT_EQ(renderer->add(avatar).value().number, first.number);
}

}  // namespace
}  // namespace raks::render
