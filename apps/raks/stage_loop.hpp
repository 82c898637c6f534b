#pragma once

#include <optional>
#include <string>

#include "apps/raks/commands.hpp"
#include "base/expected.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/show/show.hpp"
#include "render/gl/window.hpp"
#include "render/overlay/key_bindings.hpp"

namespace raks::apps {

/// Why a piece ended.
enum class StageEnd { finished, next_file, quit };

/// The main thread of `play` and `live`: draws pictures, turns keys into commands, watches the
/// device; with or without a window. One of these lives as long as the window; run() is called for
/// each file.
class StageLoop {
 public:
    /// Without `fullscreen` a window of the settings' size. Errors: no display, no OpenGL, an
    /// unknown theme or camera.
    struct Options {
        bool is_headless = false;
        bool is_fullscreen = false;
        std::optional<double> seconds;  ///< ends after this much of the music
    };
    [[nodiscard]] static Expected<StageLoop> create(const engine::Settings& settings,
                                                    const Options& options);

    /// Runs until the music ends, a key or a signal says so, or the time is up. `source`: what is
    /// played or listened to, for the overlay; `duration`: of the file, where known.
    [[nodiscard]] StageEnd run(engine::LiveGraph& graph,
                               const std::string& source,
                               std::optional<double> duration);

    /// A line for people on stderr, and for a while in the overlay.
    void say(const std::string& line);

 private:
    StageLoop(const engine::Settings& settings, const Options& options)
        : settings_(settings), options_(options) {}

    void handle_events(engine::LiveGraph& graph);
    void act(render::Action action, const KeyEvent& key, engine::LiveGraph& graph);
    void draw(engine::LiveGraph& graph, const std::string& source, std::optional<double> duration);
    void wait(engine::LiveGraph& graph);
    void select_next_dance(engine::LiveGraph& graph);
    void save_screenshot();
    [[nodiscard]] std::optional<StageEnd> end_of(engine::LiveGraph& graph) const;

    engine::Settings settings_;
    Options options_;
    // The window before what is drawn in it: its context must live longer.
    std::optional<render::Window> window_;
    std::optional<engine::Show> show_;
    std::optional<StageEnd> wish_;
    bool wants_screenshot_ = false;
    bool keeps_figure_ = false;
    Genre selected_dance_ = Genre::unknown;  // unknown: as heard
    std::string message_;
    HostTime message_until_{};
    HostTime last_picture_{};
    double fps_ = 0.0;
    float volume_ = 1.0F;
};

/// The level meter of a terminal: "[#####     ] -18.2 dBFS".
[[nodiscard]] std::string level_meter(float dbfs);

}  // namespace raks::apps
