#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "apps/raks/filmed_stage.hpp"
#include "apps/raks/recorder.hpp"
#include "base/expected.hpp"
#include "engine/live/live_graph.hpp"

namespace raks::apps {

/// Films of the show, one after another: as outputs have it, the moment that passes the sound
/// server, with the sound that is danced to. It must outlive the graphs that it follows.
/// Threads: main, with the OpenGL context current for draw() and at the end.
class ShowRecording {
 public:
    /// Size, rate and quality are those of `settings`, which must outlive this.
    explicit ShowRecording(const engine::Settings& settings) : settings_(settings) {}

    /// Begins a film; follow() gives it sound. Errors: those of Recorder::start.
    [[nodiscard]] Expected<void> start(const Path& file);
    /// Whether a film is recorded now.
    [[nodiscard]] bool is_on() const noexcept { return recorder_ != nullptr; }
    /// The sound of this graph is recorded from now on; without a film it does nothing.
    void follow(engine::LiveGraph& graph);
    /// Draws the picture that is wanted next, if any. `describe`: empty without the overlay.
    /// Errors: the driver refuses; the film has ended then.
    [[nodiscard]] Expected<void> draw(engine::LiveGraph& graph,
                                      const engine::WindowView& view,
                                      const FilmedStage::Describe& describe);
    /// Why the film has ended by itself, once.
    [[nodiscard]] std::optional<std::string> take_trouble();
    /// Completes the film. `graph`: that it follows; null: it has gone. Returns the line for the
    /// person; empty: there was no film.
    [[nodiscard]] std::string stop(engine::LiveGraph* graph);

 private:
    const engine::Settings& settings_;
    // It stays once it is there, as the audio thread may use it at any time.
    std::unique_ptr<engine::SoundTap> tap_;
    std::uint32_t source_ = 0;
    std::unique_ptr<Recorder> recorder_;
    std::optional<FilmedStage> stage_;
    bool is_reading_ = false;  // the picture that was drawn last
};

}  // namespace raks::apps
