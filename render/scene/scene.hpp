#pragma once

#include "render/scene/beat_rings.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/theme.hpp"

namespace raks::render {

/// What stands for the dancer: the skinned avatar or the stick figure.
enum class View { skin, stick };

/// What is behind the dancer: the theme's stage, or nothing (alpha 0, premultiplied colours; the
/// shadow and the rings stay) for laying the picture over others.
enum class Backdrop { stage, transparent };

/// Everything to draw besides the pose. A value; cheap to copy.
///
///     Scene scene;
///     scene.camera.orbit(0.1F, 0.0F);
///     scene.rings = beat_rings(grid, moment_shown);
///     renderer.draw(scene, track.at(moment_shown), target);
struct Scene {
    /// Skinned body or stick figure.
    View view = View::skin;
    /// Where the picture is seen from.
    Camera camera;
    const Theme* theme = &default_theme();  ///< never null
    /// Rings of light at this moment.
    BeatRings rings{};
    /// Stage or transparent.
    Backdrop backdrop = Backdrop::stage;
};

}  // namespace raks::render
