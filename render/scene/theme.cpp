#include "render/scene/theme.hpp"

#include "base/suggest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace raks::render {
namespace {

/// Linear colour of an sRGB hexadecimal one. The exponent 2.2 is the inverse of the shaders' gamma,
/// so that a colour that is not lit comes out as written.
glm::vec3 srgb(std::uint32_t hex) noexcept {
    const auto channel = [hex](unsigned shift) {
        const auto byte = static_cast<float>((hex >> shift) & 0xFFU);
        return std::pow(byte / 255.0F, 2.2F);
    };
    return {channel(16), channel(8), channel(0)};
}

/// Six dancers that differ in skin, hair and eyes; every second one wears what goes with the one
/// before.
std::array<Outfit, 6> stage_outfits() noexcept {
    return {{
        {.skin = srgb(0xd9a07c),
         .suit = srgb(0xa61b33),
         .stripe = srgb(0xf2a93b),
         .hair = srgb(0x4a2a1c),
         .shoes = srgb(0x7a1424),
         .trim = srgb(0xf2a541),
         .iris = srgb(0x8a5a2b)},
        {.skin = srgb(0xc98d66),
         .suit = srgb(0x23242e),
         .stripe = srgb(0xa61b33),
         .hair = srgb(0x211815),
         .shoes = srgb(0x191a20),
         .trim = srgb(0xc23a48),
         .iris = srgb(0x5a3a22)},
        {.skin = srgb(0x8a5a3c),
         .suit = srgb(0x12707a),
         .stripe = srgb(0xe9c46a),
         .hair = srgb(0x1d1512),
         .shoes = srgb(0x0e4d55),
         .trim = srgb(0xe9c46a),
         .iris = srgb(0x4a2c18)},
        {.skin = srgb(0xe3b394),
         .suit = srgb(0x2f3b66),
         .stripe = srgb(0xd8dbe6),
         .hair = srgb(0x9a6a35),
         .shoes = srgb(0x20294a),
         .trim = srgb(0xd8dbe6),
         .iris = srgb(0x4f7fa8)},
        {.skin = srgb(0xdcab86),
         .suit = srgb(0x6a3a86),
         .stripe = srgb(0xf0b7c8),
         .hair = srgb(0x7d2f1d),
         .shoes = srgb(0x4a2760),
         .trim = srgb(0xf0b7c8),
         .iris = srgb(0x4f7f4a)},
        {.skin = srgb(0x6e4630),
         .suit = srgb(0xd8d2c4),
         .stripe = srgb(0xb5562f),
         .hair = srgb(0x15100f),
         .shoes = srgb(0x8a4a2c),
         .trim = srgb(0xb5562f),
         .iris = srgb(0x3a2415)},
    }};
}

/// Night-blue stage with warm key light and a cold rim; the default.
Theme stage() noexcept {
    Theme theme;
    theme.name = "stage";
    theme.outfits = stage_outfits();
    theme.body = srgb(0xdcd8d0);
    theme.joint_bands = srgb(0xa61b33);
    theme.band_edge = srgb(0x2a2a30);
    theme.stick_middle = srgb(0xdcd8d0);
    theme.stick_left = srgb(0x3fb5ad);
    theme.stick_right = srgb(0xd9622f);
    theme.background_top = srgb(0x171a2a);
    theme.background_glow = srgb(0x4f5687);
    theme.background_horizon = srgb(0x252941);
    theme.floor_centre = srgb(0x6a72b8);
    theme.floor_edge = srgb(0x2c3167);
    theme.ring = srgb(0xffb454);
    theme.key_light = {2.05F, 1.86F, 1.66F};
    theme.fill_light = {0.16F, 0.24F, 0.46F};
    theme.rim_light = {1.2F, 1.5F, 2.4F};
    theme.sky_light = {0.22F, 0.26F, 0.38F};
    theme.ground_light = {0.15F, 0.11F, 0.13F};
    theme.exposure = 1.02F;
    return theme;
}

/// Dark blue and even light.
Theme workshop_dark() noexcept {
    Theme theme;
    theme.name = "workshop_dark";
    theme.outfits = stage_outfits();
    theme.body = srgb(0xdcd8d0);
    theme.joint_bands = srgb(0xd9622f);
    theme.band_edge = srgb(0x2a2a30);
    theme.stick_middle = srgb(0xdcd8d0);
    theme.stick_left = srgb(0x3fb5ad);
    theme.stick_right = srgb(0xd9622f);
    theme.background_top = srgb(0x10141d);
    theme.background_glow = srgb(0x2b3d52);
    theme.background_horizon = srgb(0x18202d);
    theme.floor_centre = srgb(0x4a6888);
    theme.floor_edge = srgb(0x1b2943);
    theme.ring = srgb(0x62d0c8);
    theme.key_light = {2.0F, 1.9F, 1.78F};
    theme.fill_light = {0.2F, 0.3F, 0.48F};
    theme.rim_light = {1.2F, 1.5F, 1.9F};
    theme.sky_light = {0.26F, 0.31F, 0.4F};
    theme.ground_light = {0.15F, 0.14F, 0.15F};
    theme.exposure = 0.7F;
    return theme;
}

/// A bright wall; the mannequin is of wood.
Theme studio_light() noexcept {
    Theme theme;
    theme.name = "studio_light";
    theme.outfits = stage_outfits();
    theme.body = srgb(0xd9bd97);
    theme.joint_bands = srgb(0xa8794e);
    theme.band_edge = srgb(0x5a3b26);
    theme.stick_middle = srgb(0xd9bd97);
    theme.stick_left = srgb(0x3f8f89);
    theme.stick_right = srgb(0xa8794e);
    theme.background_top = srgb(0xd9d4cb);
    theme.background_glow = srgb(0xf3efe8);
    theme.background_horizon = srgb(0xe6e1d9);
    theme.floor_centre = srgb(0xeae4dc);
    theme.floor_edge = srgb(0xe7dfd5);
    theme.ring = srgb(0xb05a3c);
    // A bright floor is lit mostly from all around: its shadows are pale.
    theme.floor_ambient = 0.72F;
    // Light added to a nearly white floor would not show, so here the rings cover it.
    theme.ring_cover = 1.0F;
    theme.stage_range = 0.3F;
    theme.key_light = {2.1F, 1.98F, 1.82F};
    theme.fill_light = {0.3F, 0.34F, 0.42F};
    theme.rim_light = {0.7F, 0.7F, 0.72F};
    theme.sky_light = {0.52F, 0.55F, 0.6F};
    theme.ground_light = {0.34F, 0.3F, 0.26F};
    theme.exposure = 0.66F;
    return theme;
}

/// One white light and nothing that changes colours: surfaces are shown by their own formulas.
Theme plain() noexcept {
    Theme theme = studio_light();
    theme.name = "plain";
    theme.background_top = theme.background_glow = theme.background_horizon = srgb(0x808080);
    theme.floor_centre = theme.floor_edge = srgb(0x808080);
    theme.key_light = glm::vec3(1.0F);
    theme.fill_light = theme.rim_light = theme.sky_light = theme.ground_light = glm::vec3(0.0F);
    theme.floor_ambient = 0.5F;
    theme.exposure = 1.0F;
    theme.has_tone_curve = false;
    return theme;
}

constexpr std::array<std::string_view, 3> kThemeNames = {"stage", "workshop_dark", "studio_light"};

const std::array<Theme, 4>& themes() noexcept {
    // Those of kThemeNames in their order, then the one without a stage's looks; made on first use,
    // since std::pow is not constexpr.
    static const std::array<Theme, 4> all = {stage(), workshop_dark(), studio_light(), plain()};
    return all;
}

}  // namespace

std::span<const std::string_view> theme_names() noexcept { return kThemeNames; }

const Theme& default_theme() noexcept { return themes()[0]; }

Expected<const Theme*> find_theme(std::string_view name) {
    for (const Theme& theme : themes()) {
        if (theme.name == name) {
            return &theme;
        }
    }
    return fail(unknown_name("theme", name, kThemeNames));
}

}  // namespace raks::render
