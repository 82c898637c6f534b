#pragma once

#include <array>
#include <span>
#include <string_view>

#include "base/expected.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// How the body is coloured, in every theme: the dancer's unitard with piping, or a mannequin with
/// joint bands.
enum class Dress { dancer, mannequin };

/// Colours of one dancer. Linear.
struct Outfit {
    glm::vec3 skin{};    ///< face, neck and arms
    glm::vec3 suit{};    ///< unitard and skirt
    glm::vec3 stripe{};  ///< side stripe of the suit
    glm::vec3 hair{};    ///< hair, brows and lashes
    glm::vec3 shoes{};   ///< dance shoes; soles are darker
    glm::vec3 trim{};    ///< piping along the suit's edge and the hem
    glm::vec3 iris{};    ///< of the eyes
};

/// Colours and lights of one look. Colours are linear (not sRGB), [0, 1]; lights are linear and may
/// exceed 1.
struct Theme {
    std::string_view name;  ///< as in theme_names

    std::array<Outfit, 6> outfits{};  ///< Dress::dancer: dancers of one picture differ
    // Dress::mannequin
    glm::vec3 body{};         ///< everything but the bands
    glm::vec3 joint_bands{};  ///< bands at neck, waist and limb joints
    glm::vec3 band_edge{};    ///< dark line along a band
    // stick figure
    glm::vec3 stick_middle{};  ///< trunk and head
    glm::vec3 stick_left{};    ///< the body's left side
    glm::vec3 stick_right{};   ///< the body's right side

    glm::vec3 background_top{};      ///< upper edge of the backdrop
    glm::vec3 background_glow{};     ///< its bright middle
    glm::vec3 background_horizon{};  ///< where it meets the floor
    glm::vec3 floor_centre{};        ///< albedo under the dancer
    glm::vec3 floor_edge{};          ///< albedo far out
    glm::vec3 ring{};                ///< rings of light
    float floor_ambient = 0.2F;      ///< share of the floor's light that no shadow takes, (0, 1)
    float ring_cover = 0.5F;         ///< from 0: rings add light, to 1: they cover the floor
    /// How far LightLevels move the stage: 1 in the dark; less where it is bright, as the same
    /// factor is a larger change there.
    float stage_range = 1.0F;

    glm::vec3 key_light{};       ///< main light; casts the shadow
    glm::vec3 fill_light{};      ///< lifts the dark side
    glm::vec3 rim_light{};       ///< bright edge, from behind
    glm::vec3 sky_light{};       ///< hemisphere light from above
    glm::vec3 ground_light{};    ///< and from below
    float exposure = 1.0F;       ///< factor before tone mapping
    bool has_tone_curve = true;  ///< else light is shown as it is, up to 1
};

/// Names of the stage's looks, the default first: "stage", "workshop_dark", "studio_light".
/// find_theme also knows "plain": one white light and no tone curve, to look at surfaces.
[[nodiscard]] std::span<const std::string_view> theme_names() noexcept;

/// The theme "stage". The built-in themes live as long as the program.
[[nodiscard]] const Theme& default_theme() noexcept;

/// The built-in theme of that name, never null. Errors: unknown name, with the nearest known one.
[[nodiscard]] Expected<const Theme*> find_theme(std::string_view name);

}  // namespace raks::render
