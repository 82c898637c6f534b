#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/beat_grid.hpp"
#include "base/time.hpp"
#include "render/scene/camera.hpp"
#include "render/scene/light_show.hpp"
#include "render/scene/placed_camera.hpp"
#include "render/scene/theme.hpp"

namespace raks::render {

/// A ring of light that runs outward over the floor from a beat on.
struct BeatRing {
    float radius = 0.0F;      ///< metres, from the middle of the floor
    float brightness = 0.0F;  ///< [0, 1]; 0: not drawn. 1: a downbeat at its moment
};

/// The rings that are alive; those that are not have brightness 0.
using BeatRings = std::array<BeatRing, 3>;

/// The rings of the last beats up to `time`: one leaves on every beat, a brighter one on the
/// downbeat. None where the grid's confidence is below 0.05, that is, where no beat is known. Pure.
[[nodiscard]] BeatRings beat_rings(const BeatGrid& grid, StreamTime time) noexcept;

/// Whether a beat begins a bar.
enum class BeatAccent { beat, downbeat };
/// The ring of one beat, `age` >= 0 seconds after it; brightness 0 once it has faded.
[[nodiscard]] BeatRing beat_ring(float age, BeatAccent accent) noexcept;

/// Where the music is, for what follows its beat.
struct StageBeat {
    float position = 0.0F;    ///< in beats, of a round of 16 of them; [0, 16)
    float confidence = 0.0F;  ///< that there is a beat, [0, 1]
};

/// At that time. Pure.
[[nodiscard]] StageBeat stage_beat(const BeatGrid& grid, StreamTime time) noexcept;

/// Size of a floor on which the farthest place of a dancer is `reach` metres from its middle. Pure.
[[nodiscard]] float floor_size_for(float reach) noexcept;

/// What stands for the dancer: the skinned avatar or the stick figure.
enum class View { skin, stick };

/// What is behind the dancer: the theme's stage; nothing (alpha 0, premultiplied colours; the
/// shadow and the rings stay) for laying the picture over others; or one flat colour for programs
/// that key it out: each pixel is that colour exactly or holds none of it, and the floor shows
/// neither shadow nor rings.
enum class Backdrop { stage, transparent, key };

/// Red, green and blue as they are shown.
using KeyColour = std::array<std::uint8_t, 3>;

/// A matt sphere that stands in the world.
struct LitSphere {
    glm::vec3 centre{};      ///< metres
    float radius = 0.02F;    ///< metres
    glm::vec3 colour{1.0F};  ///< what it throws back; linear
};

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
    /// From where it is seen instead, where there is one; the lights stay those of `camera`.
    std::optional<PlacedCamera> placed{};
    /// Drawn beside the dancers, once the renderer is prepared for them.
    std::vector<LitSphere> spheres{};
    const Theme* theme = &default_theme();  ///< never null
    /// Of avatars the edges of triangles alone are drawn.
    bool is_wireframe = false;
    /// What painted bodies wear.
    Dress dress = Dress::dancer;
    /// On the theme's lights.
    LightLevels light;
    /// Rings of light at this moment.
    BeatRings rings{};
    /// The beat at this moment: tiles and beams follow it.
    StageBeat beat{};
    /// What is behind the dancers.
    Backdrop backdrop = Backdrop::stage;
    /// Of Backdrop::key.
    KeyColour key{0, 255, 0};
    /// Whether the dancers throw a shadow on the floor.
    bool has_shadow = true;
    /// Whether the beat's rings are on the floor.
    bool has_rings = true;
    /// Of the floor and its pool of light, >= 1; 1: for one to three dancers (floor_size_for).
    float floor_size = 1.0F;
    /// Stream time, seconds: textures that move are where they are then.
    double seconds = 0.0;
};

}  // namespace raks::render
