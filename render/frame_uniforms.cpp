#include "render/frame_uniforms.hpp"

#include "render/avatar/avatar.hpp"
#include "render/scene/stage_light.hpp"
#include "render/scene/stage_show.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

namespace raks::render {
namespace {

constexpr float kLineHalfWidth = 0.015F;  // metres, of a beat ring
constexpr float kRingGlow = 0.25F;
// The line on the floor that is always there.
constexpr glm::vec4 kStillRing{1.25F, 0.22F, 0.008F, 0.0F};

/// std140 has no tight vec3: everything travels as a vec4.
glm::vec4 direction(glm::vec3 d) noexcept { return {d, 0.0F}; }
glm::vec4 colour(glm::vec3 c) noexcept { return {c, 1.0F}; }

float luminance(glm::vec3 light) noexcept {
    return 0.2126F * light.r + 0.7152F * light.g + 0.0722F * light.b;  // Rec. 709
}

/// A light's hue at luminance 1; of no light white.
glm::vec3 hue(glm::vec3 light) noexcept {
    return luminance(light) > 0.0F ? light / luminance(light) : glm::vec3(1.0F);
}

/// Drawn surfaces are shown as their makers painted them: a white one that faces the key light is
/// white in the light's hue. So ambient light has a share and the key light the rest.
void set_toon_lights(FrameUniforms& u, const Theme& theme, float level) noexcept {
    constexpr float kAmbientShare = 0.25F;
    const float around = 0.5F * luminance(theme.sky_light + theme.ground_light);
    const float share = around > 0.0F ? kAmbientShare : 0.0F;
    u.toon_key = colour(level * (1.0F - share) * hue(theme.key_light));
    const float scale = around > 0.0F ? level * share / around : 0.0F;
    u.toon_sky = colour(scale * theme.sky_light);
    u.toon_ground = colour(scale * theme.ground_light);
}

/// Directions come from the camera, colours from the theme, factors from the music.
void set_lights(FrameUniforms& u, const Scene& scene, const LightDirections& lights) noexcept {
    const Theme& theme = *scene.theme;
    const float key = scene.light.key;
    // The stage's colour shows on the dancers where it comes from behind and from the sides.
    const glm::vec3 tint = stage_tint(scene);
    u.key_direction = direction(lights.key);
    u.fill_direction = direction(lights.fill);
    u.rim_direction = direction(lights.rim);
    u.key_light = colour(key * theme.key_light);
    u.fill_light = colour(key * tint * theme.fill_light);
    u.rim_light = colour(scene.light.rim * tint * theme.rim_light);
    u.sky_light = colour(key * theme.sky_light);
    u.ground_light = colour(key * theme.ground_light);
    set_toon_lights(u, theme, key);
}

/// A factor on the stage, as far as the theme lets it move.
float stage_level(const Theme& theme, float level) noexcept {
    return 1.0F + theme.stage_range * (level - 1.0F);
}

/// Backdrop, floor and rings. The floor takes only the lights' hue; its brightness is the theme's.
void set_stage(FrameUniforms& u, const Scene& scene) noexcept {
    const Theme& theme = *scene.theme;
    u.display_top = colour(display_colour(lit_backdrop(scene, theme.background_top)));
    u.display_glow = colour(display_colour(lit_backdrop(scene, theme.background_glow)));
    u.display_horizon = colour(display_colour(lit_backdrop(scene, theme.background_horizon)));
    const float floor = stage_level(theme, scene.light.floor);
    u.floor_centre = colour(theme.floor_centre);
    u.floor_edge = colour(theme.floor_edge);
    const glm::vec3 lit = floor * stage_tint(scene);
    u.floor_key_tint = colour((1.0F - theme.floor_ambient) * lit * hue(theme.key_light));
    u.floor_sky_tint = colour(theme.floor_ambient * lit * hue(theme.sky_light));
    u.display_ring = {display_colour(theme.ring), theme.ring_cover};
    // The still ring takes the first of four places, the running ones the rest.
    const float shown = scene.has_rings ? 1.0F : 0.0F;
    u.rings[0] = kStillRing;
    u.rings[0].y *= shown;
    for (std::size_t i = 0; i < scene.rings.size(); ++i) {
        const BeatRing& ring = scene.rings[i];
        u.rings[i + 1] = {
            ring.radius, shown * scene.light.rings * ring.brightness, kLineHalfWidth, kRingGlow};
    }
}

/// What a theme may have besides.
void set_show(FrameUniforms& u, const Scene& scene) noexcept {
    const Theme& theme = *scene.theme;
    const float width = stage_level(theme, scene.light.width);
    u.show = {1.0F / (width * width),
              theme.tiles.size,
              static_cast<float>(std::fmod(scene.seconds, 1e4)),
              scene.light.backdrop * theme.beams.haze};
    const auto levels = tile_levels(scene);
    // They dim and brighten with the floor.
    const float floor = std::min(stage_level(theme, scene.light.floor), 1.15F);
    for (std::size_t kind = 0; kind < levels.size(); ++kind) {
        u.tiles[kind] = colour(floor * levels[kind] * display_colour(theme.tiles.colours[kind]));
    }
    for (int i = 0; i < theme.beams.count; ++i) {
        const auto place = static_cast<std::size_t>(i);
        const Beam beam = beam_at(scene, i);
        u.lamps[place] = {beam.lamp, theme.beams.strength * beam.brightness};
        u.beam_ends[place] = {beam.end, static_cast<float>(place % theme.beams.colours.size())};
    }
    for (std::size_t i = 0; i < theme.beams.colours.size(); ++i) {
        u.beam_colours[i] = colour(display_colour(stage_tint(scene) * theme.beams.colours[i]));
    }
}

/// Of frame.glsl's dither at the picture's corner.
float dither_phase(const FrameTarget& target) noexcept {
    const double phase = 0.754877666 * target.x + 0.569840296 * target.y;
    return static_cast<float>(phase - std::floor(phase));
}

/// Pixels that a mask's full range (0.04 m) covers at 1 m before the camera.
float mask_pixels(const glm::mat4& clip_from_view, float height) noexcept {
    return kMaskRange * clip_from_view[1][1] * 0.5F * height;
}

}  // namespace

glm::vec3 lit_backdrop(const Scene& scene, glm::vec3 linear) noexcept {
    return glm::min(stage_level(*scene.theme, scene.light.backdrop) * stage_tint(scene) * linear,
                    glm::vec3(1.0F));
}

glm::vec3 display_colour(glm::vec3 linear) noexcept {
    return glm::pow(linear, glm::vec3(1.0F / 2.2F));
}

namespace {

/// Blobs of all dancers one after another; frame.glsl sees their number in `counts`.
void set_blobs(FrameView& view,
               std::span<const motion::WorldPose> dancers,
               std::span<const float> scales,
               glm::vec3 key) noexcept {
    auto next = view.blobs.blobs.begin();
    for (std::size_t i = 0; i < std::min(dancers.size(), kMostShadowed); ++i) {
        const auto blobs = shadow_blobs(dancers[i], scales[i], key);
        next = std::transform(blobs.begin(), blobs.end(), next, [](const ShadowBlob& blob) {
            // Inverse squared, so that the shader does not divide.
            return glm::vec4(blob.x, blob.z, 1.0F / (blob.radius * blob.radius), blob.strength);
        });
    }
    view.uniforms.counts.x = static_cast<float>(next - view.blobs.blobs.begin());
}

/// The shadow map covers every dancer: it is centred between them and as wide as the farthest
/// needs.
void set_shadow_map(FrameView& view,
                    std::span<const motion::WorldPose> dancers,
                    std::span<const float> scales,
                    glm::vec3 key) noexcept {
    glm::vec3 centre{};
    for (const motion::WorldPose& dancer : dancers) {
        centre += dancer.position(motion::Bone::hips) / static_cast<float>(dancers.size());
    }
    float spread = 0.0F;
    for (std::size_t i = 0; i < dancers.size(); ++i) {
        const float away = glm::distance(dancers[i].position(motion::Bone::hips), centre);
        // A figure larger than the mannequin needs more to each side.
        spread = std::max(spread, away + std::max(scales[i] - 1.0F, 0.0F));
    }
    view.clip_from_light = light_clip_from_world(centre, spread, key);
    const glm::mat4 half_up = glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(0.5F)),
                                         glm::vec3(0.5F));  // [-1,1] to [0,1]
    view.uniforms.shadow_from_world = half_up * view.clip_from_light;
}

}  // namespace

FrameView frame_view(const Scene& scene,
                     std::span<const motion::WorldPose> dancers,
                     std::span<const float> scales,
                     const FrameTarget& target) noexcept {
    FrameView view;
    FrameUniforms& u = view.uniforms;
    const float width = static_cast<float>(target.width);
    const float height = static_cast<float>(target.height);
    const LightDirections lights = light_directions(scene.camera);
    const PlacedCamera eye =
        scene.placed.value_or(PlacedCamera{scene.camera.view_from_world(),
                                           scene.camera.clip_from_view(width / height),
                                           scene.camera.position()});
    u.clip_from_world = eye.clip_from_view * eye.view_from_world;
    u.eye = {eye.position, 1.0F};
    set_lights(u, scene, lights);
    set_stage(u, scene);
    set_show(u, scene);
    set_blobs(view, dancers, scales, lights.key);
    set_shadow_map(view, dancers, scales, lights.key);
    u.picture = {static_cast<float>(target.x), static_cast<float>(target.y), width, height};
    u.tone = {scene.theme->exposure,
              scene.backdrop == Backdrop::stage ? 1.0F : 0.0F,
              dither_phase(target),
              mask_pixels(eye.clip_from_view, height)};
    u.counts.y = scene.theme->has_tone_curve ? 0.0F : 1.0F;
    u.counts.z = scene.floor_size;
    u.counts.w = scene.has_shadow ? 1.0F : 0.0F;
    return view;
}

}  // namespace raks::render
