#pragma once

#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::engine {

/// What the picture settings come to.
struct Look {
    render::Scene scene;          ///< theme, camera and view
    std::string camera = "wide";  ///< the preset that the scene's camera was made from
    render::Quality quality = render::Quality::automatic;
    PictureSize size;
};

/// Errors: an unknown theme or camera (the nearest is named), a bad size.
[[nodiscard]] Expected<Look> read_look(const Settings& settings);

/// How much further away the camera stands for a formation: 1 for solo and couple.
[[nodiscard]] float distance_for(std::string_view formation) noexcept;

}  // namespace raks::engine
