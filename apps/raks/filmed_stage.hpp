#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/live/motion_stage.hpp"
#include "engine/setup/settings.hpp"
#include "engine/show/show.hpp"
#include "engine/show/staging.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/offscreen.hpp"

namespace raks::apps {

/// Goes through the hops that were danced since the last one that `staging` knows; after a long
/// pause, through those that are still known.
void follow_stage(engine::Staging& staging, const engine::StageState& stage);

/// One moment of the stage, with all its dancers.
[[nodiscard]] engine::ShownMoment shown_moment(const engine::StageState& stage, StreamTime moment);

/// The stage in pictures of their own size and moment, beside the window's: director, springs and
/// faces are their own. Threads: main, with the OpenGL context current.
class FilmedStage {
 public:
    /// Fills the overlay in; empty: the pictures have none.
    using Describe = std::function<void(const engine::ShownMoment&, render::OverlayState&)>;

    /// `size`, seed and calm are the settings'.
    FilmedStage(const engine::Settings& settings, engine::PictureSize size);

    /// The next picture is of another stream.
    void begin_anew() { staging_.begin_anew(); }
    /// Draws a moment, and begins to read the picture back. Errors: the driver refuses.
    [[nodiscard]] Expected<void> draw(const engine::StageState& stage,
                                      StreamTime moment,
                                      const engine::WindowView& view,
                                      const Describe& describe);
    /// Copies the picture that was drawn last to a target; false: it has another size.
    [[nodiscard]] bool copy_to(const render::FrameTarget& target);
    /// The picture that was drawn last: RGBA, premultiplied, top row first. Valid until the next
    /// call. Errors: the driver refuses.
    [[nodiscard]] Expected<std::span<const std::uint8_t>> picture();

 private:
    [[nodiscard]] Expected<void> make_target(int samples);
    [[nodiscard]] engine::DancerBodies& bodies_as(const engine::DancerBodies& shown);

    engine::PictureSize size_;
    engine::Staging staging_;
    std::optional<engine::DancerBodies> bodies_;
    std::optional<render::OffscreenTarget> target_;
    std::vector<std::uint8_t> rgba_;
};

}  // namespace raks::apps
