#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "base/dance_list.hpp"
#include "base/expected.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/video_output.hpp"
#include "engine/show/picture.hpp"
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

/// The stage as video outputs have it: pictures of their own size and at the moment at which the
/// sound passes the sound server, so that sound and picture belong together for who records both.
/// Director, springs and faces are the outputs' own, as their moment is another than the window's.
/// Threads: main, with the OpenGL context current for draw() and at the end.
class VideoShow {
 public:
    /// Opens the outputs that are asked for. Errors: one that cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<VideoShow>> create(
        const VideoArguments& asked,
        const engine::Settings& settings,
        std::shared_ptr<const DanceList> dances);

    /// The next picture is of another stream.
    void begin_anew() { staging_.begin_anew(); }

    /// Draws the picture that is wanted next, if any. `describe`: fills in what the moment does not
    /// know, where the outputs have the overlay.
    void draw(engine::LiveGraph& graph,
              const engine::WindowView& view,
              const std::function<void(render::OverlayState&)>& describe);

    /// Lines for the person since the last call.
    [[nodiscard]] std::vector<std::string> take_lines();
    /// What was repeated or dropped, in words.
    [[nodiscard]] std::vector<std::string> losses() const { return output_->losses(); }

 private:
    VideoShow(const VideoArguments& asked,
              const engine::Settings& settings,
              std::shared_ptr<const DanceList> dances,
              std::unique_ptr<engine::VideoOutput> output);

    void pass_on();
    void draw_picture(HostTime due,
                      engine::LiveGraph& graph,
                      const engine::WindowView& view,
                      const std::function<void(render::OverlayState&)>& describe);
    [[nodiscard]] bool make_target(int samples);
    [[nodiscard]] engine::DancerBodies& bodies_as(const engine::DancerBodies& shown);

    std::shared_ptr<const DanceList> dances_;
    Nanos offset_;
    bool has_overlay_;
    std::unique_ptr<engine::VideoOutput> output_;
    engine::Staging staging_;
    std::optional<engine::DancerBodies> bodies_;
    std::optional<render::OffscreenTarget> target_;
    std::optional<HostTime> reading_;  // when the picture that is read back is due
    std::vector<std::uint8_t> rgba_;
    std::string trouble_;
    bool has_failed_ = false;
};

}  // namespace raks::apps
