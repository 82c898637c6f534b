#include "engine/show/show.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>
#include <memory>
#include <utility>

#include "render/scene/scene.hpp"

namespace raks::engine {

namespace {

// Where a dancer looks: at the camera, as far as it stands before the stage. Who is filmed from the
// side goes on dancing for those in front.
render::Camera audience(render::Camera camera) noexcept {
    constexpr float kWidest = glm::radians(35.0F);
    camera.yaw = std::clamp(camera.yaw, -kWidest, kWidest);
    return camera;
}

/// What dancers wear once the renderer has all bodies; it has those of `worn`.
Expected<DancerBodies::Wardrobe> add_all(const Costumes& costumes,
                                         const DancerBodies::Wardrobe& worn,
                                         render::Renderer& renderer) {
    DancerBodies::Builds added;
    for (const std::shared_ptr<const render::Avatar>& body : costumes.bodies) {
        if (const auto known = find_worn(worn, body)) {
            added.push_back(*known);
            continue;
        }
        const auto handle = renderer.add(*body);
        if (!handle) {
            return fail(handle.error());
        }
        added.push_back({*handle, body});
    }
    return wardrobe_of(costumes, added);
}

}  // namespace

Expected<Drawing> create_drawing(const Look& look) {
    // Bodies that are not loaded yet are made while the shaders are compiled.
    auto making = std::async(std::launch::async, [&look] {
        return costumes_of(look.avatars.empty() ? std::vector<LoadedAvatar>{mannequin(look.costume)}
                                                : look.avatars,
                           look.partners);
    });
    auto renderer = render::Renderer::create({.quality = look.quality});
    if (!renderer) {
        return fail(renderer.error());
    }
    auto overlay = render::Overlay::create();
    if (!overlay) {
        return fail(overlay.error());
    }
    auto wardrobe = add_all(making.get(), {}, *renderer);
    if (!wardrobe) {
        return fail(wardrobe.error());
    }
    return Drawing{std::move(*renderer),
                   DancerBodies(std::move(*wardrobe), motion::mannequin_skeleton(), look.face),
                   std::move(*overlay)};
}

Expected<void> wear_at_once(const std::vector<LoadedAvatar>& avatars,
                            Partners partners,
                            Drawing& drawing) {
    auto wardrobe =
        add_all(costumes_of(avatars, partners), drawing.bodies.wardrobe(), drawing.renderer);
    if (!wardrobe) {
        return fail(wardrobe.error());
    }
    const auto before = drawing.bodies.wear(std::move(*wardrobe));
    for (const DancerBodies::Builds& builds : before) {
        for (const DancerBodies::Worn& worn : builds) {
            if (!find_worn(drawing.bodies.wardrobe(), worn.avatar)) {
                drawing.renderer.remove(worn.handle);
            }
        }
    }
    return {};
}

Expected<Show> Show::create(const Look& look,
                            bool has_overlay,
                            std::shared_ptr<const DanceList> dances) {
    auto drawing = create_drawing(look);
    if (!drawing) {
        return fail(drawing.error());
    }
    return Show(look, std::move(*drawing), has_overlay, std::move(dances));
}

Show::Show(const Look& look,
           Drawing drawing,
           bool has_overlay,
           std::shared_ptr<const DanceList> dances)
    : dances_(std::move(dances)),
      scene_(look.scene),
      preset_(look.scene.camera),
      staging_(look.seed, look.liveliness),
      camera_name_(look.camera),
      camera_motion_(look.camera_motion),
      drawing_(std::move(drawing)),
      avatars_(look.avatars),
      partners_(look.partners),
      dress_(look),
      overlay_view_(has_overlay ? render::OverlayView::shown : render::OverlayView::hidden) {
    staging_.set_picture(static_cast<float>(look.size.width) / static_cast<float>(look.size.height),
                         drawing_.bodies.size());
}

void Show::draw(const ShownMoment& shown,
                render::OverlayState info,
                const render::FrameTarget& target) {
    const DancedMoment& danced = shown.danced;
    if (const auto costume = dress_.next(shown, *dances_)) {
        avatars_ = dressed(std::move(avatars_), *costume);
        // Where the driver refuses them the film goes on in those that are worn.
        static_cast<void>(wear_at_once(avatars_, partners_, drawing_));
    }
    if (camera_motion_) {
        scene_.camera = camera_motion_->at(info.position.value_or(to_seconds(danced.moment)),
                                           drawing_.bodies.size());
    }
    staging_.set(scene_,
                 {.name = camera_name_, .preset = preset_, .is_held = camera_motion_ != nullptr},
                 {.time = danced.moment, .lead = danced.lead},
                 danced.tracks);
    // The picture first: the overlay is drawn over it.
    draw_moment(shown, drawing_.renderer, drawing_.bodies, scene_, target);
    describe_moment(shown, *dances_, info);
    drawing_.overlay.draw(info, overlay_view_, target);
}

void draw_moment(const ShownMoment& shown,
                 render::Renderer& renderer,
                 DancerBodies& bodies,
                 render::Scene& scene,
                 const render::FrameTarget& target) {
    // The rings follow the beat grid at the moment that is shown, which lies between two states.
    scene.rings = render::beat_rings(shown.music.grid, shown.danced.moment);
    scene.beat = render::stage_beat(shown.music.grid, shown.danced.moment);
    scene.floor_size = render::floor_size_for(bodies.reach_of(shown.danced.places));
    scene.seconds = to_seconds(shown.danced.moment);
    renderer.draw(scene, bodies.at(shown.danced, shown.music, audience(scene.camera)), target);
}

// From this confidence on the place in the bar is shown.
constexpr float kKnownBar = 0.3F;

void describe_moment(const ShownMoment& shown,
                     const DanceList& dances,
                     render::OverlayState& state) noexcept {
    const BeatGrid& grid = shown.music.grid;
    // The grid is extended to the moment: the picture may lie ahead of the newest state.
    const Beats position = grid.beats_at(shown.danced.moment);
    state.bpm = grid.tempo.bpm();
    state.confidence = grid.confidence;
    // Told where the two are near each other.
    constexpr float kNearRival = 0.15F;
    const RivalTempo& rival = shown.music.rival;
    const bool is_near =
        rival.probability > kNearRival && 2.0F * rival.probability > grid.confidence;
    state.rival_bpm = is_near ? rival.bpm : 0.0;
    state.beats_per_bar = grid.beats_per_bar;
    state.is_bar_known = grid.bar_confidence > kKnownBar;
    state.bar_position = grid.bar_position(position);
    state.is_silent = shown.music.is_silent;
    state.genre = dances.title_of(shown.music.genre);
    state.is_genre_told = shown.music.is_genre_told;
    state.tags = shown.music.tags;
    // Posteriors are stored as natural logarithms.
    state.genre_posterior = std::exp(shown.music.genre_log_probability[shown.music.genre_class]);
    const auto& figure = shown.dancer.figure;
    // At most the array's size: the name fills it without a zero when it is long.
    state.figure = std::string_view(figure.data(), strnlen(figure.data(), figure.size()));
    state.dance =
        // While the dancer stands, no dance is named.
        shown.dancer.is_dancing ? dances.title_of(shown.dancer.dance) : std::string_view{};
    // A take is longer than a figure and than there is room: its beats are counted by eights.
    constexpr int kMostCounts = 16;
    constexpr int kEight = 8;
    const bool is_take = shown.dancer.counts > kMostCounts && shown.dancer.count > 0;
    state.figure_count = is_take ? (shown.dancer.count - 1) % kEight + 1 : shown.dancer.count;
    state.figure_counts = shown.dancer.counts > kMostCounts ? kEight : shown.dancer.counts;
    state.level_dbfs = shown.music.level_dbfs;
    state.loudness_lufs = shown.music.loudness_lufs;
}

}  // namespace raks::engine
