#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/kept_window.hpp"
#include "apps/raks/show_recording.hpp"
#include "apps/raks/video_show.hpp"
#include "base/expected.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/live_actions.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/setup/formations.hpp"
#include "engine/show/staging.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/offscreen.hpp"

namespace raks::apps {

/// Why run() ended.
enum class StageEnd { finished, next_file, previous_file, quit };

/// What is playing, for the overlay.
struct StageSource {
    /// What comes when a file has ended. `stay`: a window stays open, its dancer still, until
    /// somebody goes back or quits; without a window as `end`.
    enum class Behind { next_file, end, stay };

    std::string name;                               ///< title or file; `live`: empty
    std::optional<double> duration = std::nullopt;  ///< of the file in seconds, where known
    double start = 0.0;                             ///< where in the file it began, in seconds
    Behind behind = Behind::end;                    ///< the file's end
    std::function<void()> each_picture = {};        ///< called with every picture; may be empty
    /// Who says which dance it is where that is not heard: "as the file says".
    std::string_view teller = "as the file says";
    /// Keeps a dance for what is playing and returns the line that says so, or why not; empty: it
    /// is no file. The dance is empty where none was chosen by hand.
    std::function<std::string(std::string_view dance)> keep_dance = {};
};

/// The main thread of `play` and `live`: draws pictures, carries out actions and watches the
/// device, with or without a window. One lives as long as the window; run() is called for each
/// file. Threads: main.
class StageLoop final : private engine::WindowContent {
 public:
    /// How the stage is shown and when it ends.
    struct Options {
        bool is_headless = false;                      ///< no window: a line of progress instead
        WindowWish window;                             ///< of the settings' size where windowed
        std::optional<double> seconds;                 ///< ends after this much of the music
        std::vector<engine::OutputWish> outputs = {};  ///< who is told of the music
        VideoArguments video = {};                     ///< who has the pictures, too
        KeptWindow kept = {};                          ///< where the window was before
    };
    /// `formations` must outlive this. Errors: no display, no OpenGL, an unknown theme
    /// or camera, an output that cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<StageLoop>> create(
        const engine::Settings& settings,
        const Options& options,
        std::shared_ptr<const DanceList> dances,
        engine::Formations& formations);
    /// Not copied: actions and window hold references to it.
    StageLoop(const StageLoop&) = delete;
    StageLoop& operator=(const StageLoop&) = delete;  ///< likewise
    ~StageLoop() override;                            ///< completes a film that is recorded

    /// Runs until the music ends, a person or a signal ends it, or the time is up. `graph` must
    /// outlive the call. Returns why it ended.
    [[nodiscard]] StageEnd run(engine::LiveGraph& graph, const StageSource& source);

    /// Why nothing can be shown any more (render::Window::why_lost); empty: it can, or there is no
    /// window. Then run() has ended.
    [[nodiscard]] std::string_view why_lost() const { return window_ ? window_->why_lost() : ""; }
    /// Between two files: whether a person or a signal has asked for the end.
    [[nodiscard]] bool is_end_wanted();

    /// Prints a line for people on stderr, and shows it over the picture for a while.
    void say(const std::string& line);
    /// Shows it over the picture alone; without a window it does nothing.
    void show(const std::string& line);

 private:
    StageLoop(const engine::Settings& settings,
              const Options& options,
              std::shared_ptr<const DanceList> dances,
              engine::Formations& formations);

    void advance(double seconds) override;
    void draw_elsewhere(const engine::WindowView& view) override;
    void draw(const engine::WindowPicture& picture, render::OverlayState& overlay) override;
    void use(render::OverlayControl control, double share) override;
    [[nodiscard]] bool is_finished() const override;
    [[nodiscard]] bool has_director() const override { return true; }
    [[nodiscard]] render::Camera framed(render::Camera preset) const override;
    void say_told_dance();

    void bind(engine::ActionDispatcher& actions);
    [[nodiscard]] const std::string& source_name() const;
    [[nodiscard]] Expected<void> open_pictures(const engine::Look& look);
    void run_headless();
    void draw_headless();
    void toggle_recording();
    void describe(const engine::StageState& stage, render::OverlayState& overlay);
    void select_next_dance();
    void keep_dance();
    void repeat_selected_dance();
    void say_losses(const engine::LiveCounters& lost) const;
    void toggle_figure_view();
    void bind_playing(engine::ActionDispatcher& actions);
    void go_back();
    void go_on();
    void toggle_pause();
    void seek_to(double seconds);
    void keep_memory();
    [[nodiscard]] bool has_ended() const;
    void carry_over();
    void note_figure(engine::LiveGraph& graph);
    void ask_for_next_formation();
    void change_formation();
    void change_bodies();

    engine::Settings settings_;
    Options options_;
    std::shared_ptr<const DanceList> dances_;
    engine::Formations& formations_;
    // Without a window, where the pictures go elsewhere. The context lives longest.
    struct Studio {
        render::OffscreenContext context;
        engine::Drawing drawing;
        render::Scene scene;
        std::string camera;
    };
    std::optional<Studio> studio_;
    std::optional<engine::WindowLoop> window_;
    std::unique_ptr<VideoShow> video_;  // needs the context of one of both
    ShowRecording recording_;           // likewise
    engine::Staging staging_;
    engine::LiveActions live_actions_;
    std::unique_ptr<engine::Outputs> outputs_;
    std::string formation_;                   // whose distance the camera has
    DanceId selected_dance_ = DanceId::none;  // none: the recognised one
    // What was danced when the last file ended; kept with K, it goes on with the next file.
    DanceId last_dance_ = DanceId::none;
    DanceId told_dance_ = DanceId::none;  // by the file, as last said
    std::string last_figure_;
    // While run() runs.
    engine::LiveGraph* graph_ = nullptr;
    StageSource source_;
    std::optional<StageEnd> wish_;
    bool had_ended_ = false;
    bool has_said_unlocked_ = false;
};

/// What the settings say of a live graph's sound: buffer, offsets, pose lead. The offsets kept for
/// devices are read; where they cannot be, one line says why and none count.
[[nodiscard]] engine::LiveGraphConfig sound_config(const engine::Settings& settings);

/// The level meter of a terminal: "[#####     ] -18.2 dBFS".
[[nodiscard]] std::string level_meter(float dbfs);

}  // namespace raks::apps
