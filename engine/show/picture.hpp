#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/camera_motion.hpp"
#include "engine/show/dancer_face.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/show/staging.hpp"
#include "render/model/mannequin_style.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::engine {

/// The picture settings, checked and resolved.
struct Look {
    render::Scene scene;            ///< theme, dress, view, and a camera to begin with
    std::string camera{kDirector};  ///< or the preset that the scene's camera was made from
    std::uint64_t seed = 1;         ///< of the director's choices
    render::Liveliness liveliness = render::Liveliness::usual;  ///< of director and light
    render::Quality quality = render::Quality::automatic;       ///< for the renderer
    PictureSize size;                   ///< of the window or film, in pixels
    FaceHabits face;                    ///< what faces do by themselves
    std::vector<LoadedAvatar> avatars;  ///< worn in turn (put_on); none: the mannequin
    Partners partners = Partners::all;  ///< who is seen in the first picture
    /// What the pictures on each avatar may take of a driver's memory (AvatarOptions).
    std::size_t most_image_bytes = render::kUsualImageBytes;
    bool dresses_by_dance = false;  ///< the dance chooses what the mannequin wears
    std::string dance;              ///< that is asked for; empty: any
    /// What the mannequin wears, to begin with where the dance chooses it.
    render::Costume costume = render::Costume::unitard;
    /// What moves the camera of a film in the place of `camera`; none: nothing does.
    std::shared_ptr<const CameraMotion> camera_motion{};
    std::vector<std::string> notes;  ///< a line for each setting that could not be had
};

/// What the settings say of faces. Pure.
[[nodiscard]] FaceHabits face_habits(const Settings& settings) noexcept;

/// Resolves the settings, but for the avatar. A theme that is unknown or cannot be read is noted,
/// and the default stands in for it. `settings`: valid. Errors: an unknown backdrop, a bad size.
[[nodiscard]] Expected<Look> read_look(const Settings& settings);

/// Lays a backdrop behind the dancers. The key colour of a scene stays where none is asked for.
/// Pure.
void set_backdrop(render::Scene& scene, const AskedBackdrop& backdrop) noexcept;

/// The word of a scene's backdrop, as parse_backdrop takes it. Pure.
[[nodiscard]] std::string backdrop_word(const render::Scene& scene);

/// Puts avatars on, at least one, and the camera where the size of the largest asks for. Pure.
void put_on(std::vector<LoadedAvatar> avatars, Look& look) noexcept;

/// A camera preset for dancers of another size than the mannequin's 1: as far away and as high as
/// shows them as large.
[[nodiscard]] render::Camera camera_for(render::Camera preset, float size) noexcept;

/// Factor on the camera's distance for a formation: 1 for solo and couple, more where several
/// dancers stand side by side.
[[nodiscard]] float distance_for(std::string_view formation) noexcept;

/// The preset of that name, as wide for the director and for what is none. Pure.
[[nodiscard]] render::Camera preset_of(std::string_view camera) noexcept;

}  // namespace raks::engine
