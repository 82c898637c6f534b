#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "engine/show/picture.hpp"
#include "motion/dancer.hpp"
#include "render/gl/frame_target.hpp"
#include "render/overlay/overlay.hpp"
#include "render/renderer.hpp"

namespace raks::engine {

/// What a picture is about: one moment of the dance.
struct ShownMoment {
    const MusicState& music;
    const motion::DancerStatus& dancer;
    std::span<const motion::Pose> poses;  ///< one a dancer
    StreamTime moment;                    ///< what is seen and heard then
};

/// What every picture is drawn by: the renderer, with the mannequin, and the overlay.
struct Drawing {
    render::Renderer renderer;
    render::Overlay overlay;
};
/// An OpenGL context must be current. Errors: the driver refuses.
[[nodiscard]] Expected<Drawing> create_drawing(const Look& look);

/// Draws the stage and who dances on it; the floor shows the beat.
void draw_moment(const ShownMoment& shown,
                 render::Renderer& renderer,
                 render::Scene& scene,
                 const render::FrameTarget& target);

/// Draws pictures of the dance for a film: stage, dancers and overlay, as a window shows them.
/// Threads: the OpenGL context's. Real-time: no.
class Show {
 public:
    /// An OpenGL context must be current. Errors: the driver refuses.
    [[nodiscard]] static Expected<Show> create(const Look& look,
                                               bool has_overlay,
                                               std::shared_ptr<const DanceList> dances);

    /// Draws one picture. `info` brings what the moment does not know: source, position, latency,
    /// counters; tempo, bar, genre, figure and levels are filled in here.
    void draw(const ShownMoment& shown,
              render::OverlayState info,
              const render::FrameTarget& target);

    /// Samples a pixel that a target should have.
    [[nodiscard]] int samples() const noexcept { return renderer_.samples(); }

 private:
    Show(const Look& look,
         Drawing drawing,
         bool has_overlay,
         std::shared_ptr<const DanceList> dances);

    std::shared_ptr<const DanceList> dances_;
    render::Scene scene_;
    render::Renderer renderer_;
    render::Overlay overlay_;
    render::OverlayView overlay_view_;
};

/// A moment filled into what the overlay shows, whose names are those of `dances`. Pure.
void describe_moment(const ShownMoment& shown,
                     const DanceList& dances,
                     render::OverlayState& state) noexcept;

}  // namespace raks::engine
