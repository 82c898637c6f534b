#pragma once

#include <span>
#include <string_view>

#include "base/expected.hpp"

#include <glm/vec3.hpp>

namespace raks::render {

/// How the body is coloured: the dancer's unitard with piping, or a mannequin with joint bands.
enum class Dress { dancer, mannequin };

/// Colours and lights of one look. Colours are linear (not sRGB), [0, 1]; lights are linear and may
/// exceed 1.
struct Theme {
    std::string_view name;
    Dress dress = Dress::dancer;

    // Dress::dancer
    glm::vec3 skin{};
    glm::vec3 suit{};
    glm::vec3 stripe{};
    glm::vec3 hair{};
    glm::vec3 shoes{};
    glm::vec3 trim{};
    // Dress::mannequin
    glm::vec3 body{};
    glm::vec3 joint_bands{};
    glm::vec3 band_edge{};
    // stick figure
    glm::vec3 stick_middle{};
    glm::vec3 stick_left{};
    glm::vec3 stick_right{};

    glm::vec3 background_top{};
    glm::vec3 background_glow{};
    glm::vec3 background_horizon{};
    glm::vec3 floor_centre{};
    glm::vec3 floor_edge{};
    glm::vec3 ring{};
    float floor_ambient = 0.2F;  ///< share of the floor's light that no shadow takes, (0, 1)
    float ring_cover = 0.5F;     ///< from 0: rings add light, to 1: they cover the floor

    glm::vec3 key_light{};
    glm::vec3 fill_light{};
    glm::vec3 rim_light{};
    glm::vec3 sky_light{};     ///< hemisphere light from above
    glm::vec3 ground_light{};  ///< and from below
    float exposure = 1.0F;
};

/// Names for --theme, the default first: "stage", "workshop_dark", "studio_light".
[[nodiscard]] std::span<const std::string_view> theme_names() noexcept;

/// The theme "stage". The built-in themes live as long as the program.
[[nodiscard]] const Theme& default_theme() noexcept;

/// The built-in theme of that name, never null. Errors: unknown name, with the nearest known one.
[[nodiscard]] Expected<const Theme*> find_theme(std::string_view name);

}  // namespace raks::render
