#pragma once

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::engine {

/// What the picture settings come to.
struct Look {
    render::Scene scene;  ///< theme, camera and view
    render::Quality quality = render::Quality::automatic;
    PictureSize size;
};

/// Errors: an unknown theme or camera (the nearest is named), a bad size.
[[nodiscard]] Expected<Look> read_look(const Settings& settings);

}  // namespace raks::engine
