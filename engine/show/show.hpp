#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "engine/show/dancer_bodies.hpp"
#include "engine/show/dress_by_dance.hpp"
#include "engine/show/loaded_avatar.hpp"
#include "engine/show/picture.hpp"
#include "engine/show/shown_moment.hpp"
#include "engine/show/staging.hpp"
#include "motion/dancer.hpp"
#include "render/gl/frame_target.hpp"
#include "render/overlay/overlay.hpp"
#include "render/renderer.hpp"

namespace raks::engine {

/// What every picture is drawn with.
struct Drawing {
    render::Renderer renderer;  ///< with the avatar's mesh
    DancerBodies bodies;        ///< who wears it
    render::Overlay overlay;    ///< text and meters over the picture
};
/// Makes both. An OpenGL context must be current. Errors: the driver refuses.
[[nodiscard]] Expected<Drawing> create_drawing(const Look& look);

/// The dancers wear these avatars, at least one, at once: for pictures that wait for it. Errors:
/// the driver refuses; they keep what they wear.
[[nodiscard]] Expected<void> wear_at_once(const std::vector<LoadedAvatar>& avatars,
                                          Partners partners,
                                          Drawing& drawing);

/// Draws the stage and the dancers; rings on the floor show the beat.
void draw_moment(const ShownMoment& shown,
                 render::Renderer& renderer,
                 DancerBodies& bodies,
                 render::Scene& scene,
                 const render::FrameTarget& target);

/// Draws the pictures of a film: stage, dancers and overlay, as a window shows them.
/// Threads: the OpenGL context's. Real-time: no.
class Show {
 public:
    /// An OpenGL context must be current. Errors: the driver refuses.
    [[nodiscard]] static Expected<Show> create(const Look& look,
                                               bool has_overlay,
                                               std::shared_ptr<const DanceList> dances);

    /// Takes each hop, before the pictures of its time are drawn: see Staging.
    void advance(const MusicState& music, std::span<const motion::PoseTrack> tracks) {
        staging_.advance(music, tracks);
    }

    /// Draws one picture. `info` holds what the moment does not know (source, position, latency,
    /// counters); tempo, bar, genre, figure and levels are filled in here.
    void draw(const ShownMoment& shown,
              render::OverlayState info,
              const render::FrameTarget& target);

    /// Samples a pixel that a render target should have.
    [[nodiscard]] int samples() const noexcept { return drawing_.renderer.samples(); }

 private:
    Show(const Look& look,
         Drawing drawing,
         bool has_overlay,
         std::shared_ptr<const DanceList> dances);

    std::shared_ptr<const DanceList> dances_;
    render::Scene scene_;
    render::Camera preset_;
    Staging staging_;
    std::string camera_name_;
    std::shared_ptr<const CameraMotion> camera_motion_;  // null: none
    Drawing drawing_;
    std::vector<LoadedAvatar> avatars_;  // that are worn
    Partners partners_;
    DressByDance dress_;
    render::OverlayView overlay_view_;
};

/// Fills a moment into the overlay's state; names are those of `dances`. Pure.
void describe_moment(const ShownMoment& shown,
                     const DanceList& dances,
                     render::OverlayState& state) noexcept;

}  // namespace raks::engine
