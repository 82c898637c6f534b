#pragma once

#include <array>
#include <string>
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

/// A floor of glowing tiles that follow beat and bands. Tiles of four kinds are spread over it:
/// each swells on one beat of four and with one band of the music.
struct TileFloor {
    float size = 0.0F;                   ///< metres, of a tile's edge; 0: there are no tiles
    float glow = 0.0F;                   ///< of a tile at rest, as a share of one at its brightest
    std::array<glm::vec3, 4> colours{};  ///< by kind; linear
};

/// Beams of light in haze, from lamps over and behind the dancers; they sweep with the beat and
/// brighten with the bands of the music.
struct LightBeams {
    int count = 0;          ///< lamps side by side, up to kMostBeams; 0: there are none
    float strength = 0.0F;  ///< light added where a beam is brightest
    float haze = 0.0F;      ///< light added to the air before the backdrop
    std::array<glm::vec3, 3> colours{};  ///< of lamps side by side, in turn; linear
};
/// Most lamps of a theme.
inline constexpr int kMostBeams = 12;

/// Colours and lights of one look. Colours are linear (not sRGB), [0, 1]; lights are linear and may
/// exceed 1. File format: docs/reference/files.md.
struct Theme {
    std::string name;       ///< as in messages and for --theme
    bool is_listed = true;  ///< among those that a key goes through

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

    glm::vec3 breakdown_tint{1.0F};  ///< factor on the stage's light in a breakdown
    glm::vec3 drop_tint{1.0F};       ///< and as a drop opens it
    TileFloor tiles;                 ///< on the floor
    LightBeams beams;                ///< over the stage
};

/// The theme "stage", which is a part of the program. Lives as long as it.
[[nodiscard]] const Theme& default_theme() noexcept;

/// Reads a theme's file. What it does not hold is as in `base`, but for its name. `name`: of the
/// theme. `file`: for errors. Errors: no TOML; another format or version; an unknown key; a value
/// of the wrong kind or out of its range. Threads: any. Real-time: no.
[[nodiscard]] Expected<Theme> parse_theme(std::string_view toml,
                                          const std::string& name,
                                          const std::string& file,
                                          const Theme& base = default_theme());

}  // namespace raks::render
