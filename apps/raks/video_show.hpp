#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/filmed_stage.hpp"
#include "base/expected.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/video_output.hpp"

namespace raks::apps {

/// The stage as video outputs have it: pictures of the moment at which the sound passes the sound
/// server, so that sound and picture belong together for who records both.
/// Threads: main, with the OpenGL context current for draw() and at the end.
class VideoShow {
 public:
    /// Opens the outputs that are asked for. Errors: one that cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<VideoShow>> create(
        const VideoArguments& asked, const engine::Settings& settings);

    /// The next picture is of another stream.
    void begin_anew() { stage_.begin_anew(); }

    /// Draws the picture that is wanted next, if any. `describe`: for outputs that have the
    /// overlay.
    void draw(engine::LiveGraph& graph,
              const engine::WindowView& view,
              const FilmedStage::Describe& describe);

    /// Puts the picture that the last draw() has drawn into a window of its size, where that shows
    /// nearly the same moment: then it is drawn once for both. False: there is none.
    [[nodiscard]] bool show(const render::FrameTarget& window, StreamTime moment);

    /// Lines for the person since the last call.
    [[nodiscard]] std::vector<std::string> take_lines();
    /// What was repeated or dropped, in words.
    [[nodiscard]] std::vector<std::string> losses() const { return output_->losses(); }

 private:
    VideoShow(const VideoArguments& asked,
              FilmedStage stage,
              std::unique_ptr<engine::VideoOutput> output);
    void pass_on();
    void give_up(const Error& why);

    Nanos offset_;
    bool has_overlay_;
    std::unique_ptr<engine::VideoOutput> output_;
    FilmedStage stage_;
    std::optional<StreamTime> drawn_;  // moment of the picture of the last draw(), if there is one
    std::optional<HostTime> reading_;  // when the picture that is read back is due
    std::string trouble_;
    bool has_failed_ = false;
};

}  // namespace raks::apps
