#include "engine/show/picture.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/setup/asked_formation.hpp"
#include "engine/show/themes.hpp"
#include "render/avatar/avatar.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// Three dancers side by side fit into the picture at this distance.
constexpr float kWideFormation = 1.35F;

}  // namespace

FaceHabits face_habits(const Settings& settings) noexcept {
    return {.blinks = settings.face_blink,
            .moves_mouth = settings.face_mouth,
            .gazes = settings.face_gaze,
            .mood = mood_size(settings.face_mood)};
}

Expected<Look> read_look(const Settings& settings) {
    Look look;
    if (const auto theme = find_theme(settings.theme)) {
        look.scene.theme = *theme;
    } else {
        look.notes.push_back(fmt::format("{}; the theme \"{}\" is shown instead",
                                         theme.error().message,
                                         look.scene.theme->name));
    }
    look.scene.camera = preset_of(settings.camera);
    // zoom() multiplies the camera's distance.
    look.scene.camera.zoom(distance_for(name_of(asked_formation(settings))));
    const bool is_alone = name_of(asked_formation(settings)) == "solo" && settings.dancers <= 1;
    look.partners = is_alone ? Partners::first : Partners::all;
    look.camera = settings.camera;
    look.seed = static_cast<std::uint64_t>(settings.seed);
    look.liveliness = settings.calm ? render::Liveliness::calm : render::Liveliness::usual;
    look.scene.dress =
        settings.dress == "mannequin" ? render::Dress::mannequin : render::Dress::dancer;
    look.dresses_by_dance = settings.dress == "auto";
    look.costume = render::find_costume(settings.dress).value_or(render::Costume::unitard);
    look.dance = settings.dance == "auto" ? std::string() : settings.dance;
    const auto backdrop = parse_backdrop(settings.backdrop);
    if (!backdrop) {
        return fail(backdrop.error());
    }
    set_backdrop(look.scene, *backdrop);
    look.scene.has_shadow = settings.shadow;
    look.scene.has_rings = settings.rings;
    const auto size = parse_size(settings.size);
    if (!size) {
        return fail(size.error());
    }
    look.size = *size;
    look.face = face_habits(settings);
    // "auto" shows figures that were learnt as joint positions as sticks.
    const bool is_stick =
        settings.view == "stick" || (settings.view == "auto" && settings.figures == "positions");
    look.scene.view = is_stick ? render::View::stick : render::View::skin;
    // validate() has refused other names; "auto" is what is left.
    look.quality = settings.quality == "fast"   ? render::Quality::fast
                   : settings.quality == "high" ? render::Quality::high
                                                : render::Quality::automatic;
    return look;
}

void set_backdrop(render::Scene& scene, const AskedBackdrop& backdrop) noexcept {
    scene.backdrop = backdrop.is_stage ? render::Backdrop::stage
                     : backdrop.key    ? render::Backdrop::key
                                       : render::Backdrop::transparent;
    scene.key = backdrop.key.value_or(scene.key);
}

std::string backdrop_word(const render::Scene& scene) {
    switch (scene.backdrop) {
        case render::Backdrop::stage:
            return "stage";
        case render::Backdrop::transparent:
            return "transparent";
        case render::Backdrop::key:
            break;
    }
    return fmt::format("#{:02x}{:02x}{:02x}", scene.key[0], scene.key[1], scene.key[2]);
}

void put_on(std::vector<LoadedAvatar> avatars, Look& look) noexcept {
    float largest = 0.0F;
    for (const LoadedAvatar& avatar : avatars) {
        largest = std::max(largest, render::size_of(*avatar.avatar));
    }
    look.scene.camera = camera_for(look.scene.camera, largest);
    look.avatars = std::move(avatars);
}

render::Camera camera_for(render::Camera preset, float size) noexcept {
    preset.target *= size;
    preset.zoom(size);
    return preset;
}

render::Camera preset_of(std::string_view camera) noexcept {
    return render::find_camera(camera).value_or(render::Camera());
}

float distance_for(std::string_view formation) noexcept {
    return formation == "solo" || formation == "couple" ? 1.0F : kWideFormation;
}

}  // namespace raks::engine
