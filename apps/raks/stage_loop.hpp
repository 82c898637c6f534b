#pragma once

#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/dance_choice.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/kept_window.hpp"
#include "apps/raks/play_queue.hpp"
#include "apps/raks/player_desk.hpp"
#include "apps/raks/preset_choice.hpp"
#include "apps/raks/remote_desk.hpp"
#include "apps/raks/show_recording.hpp"
#include "apps/raks/source_choice.hpp"
#include "apps/raks/video_show.hpp"
#include "base/expected.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/live_actions.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/setup/formations.hpp"
#include "engine/show/avatar_change.hpp"
#include "engine/show/clip_performance.hpp"
#include "engine/show/dress_by_dance.hpp"
#include "engine/show/staging.hpp"
#include "engine/show/window_loop.hpp"
#include "render/gl/offscreen.hpp"

namespace raks::apps {

/// Why run() ended. `chosen_file`: the queue has gone to another file; `wish`: see take_wish().
enum class StageEnd : std::uint8_t { finished, next_file, previous_file, chosen_file, wish, quit };

/// What a person asks for in the window that a stage does not do by itself.
struct StageWish {
    /// What of the show is to be another one.
    enum class Kind : std::uint8_t {
        music,   ///< `files` play
        input,   ///< what the input `name` hears is danced to
        output,  ///< music plays on the loudspeaker `name`
        dances,  ///< `setup` takes over; `name` is danced
    };
    Kind kind{};                             ///< which
    std::vector<Path> files = {};            ///< files, folders, playlists
    std::string name = {};                   ///< of a device or a dance
    std::shared_ptr<StageSetup> setup = {};  ///< another set of dances
};

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
    PlayQueue* queue = nullptr;                     ///< the files that play; null: it is no file
    /// Who says which dance it is where that is not heard: "as the file says".
    std::string_view teller = "as the file says";
    /// What the graph's analysis knows; null: no player is asked what it plays.
    const engine::AnalyzerModels* models = nullptr;
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
        RemoteArguments remote = {};                   ///< who else asks for actions
        std::optional<bool> now_playing = {};          ///< PlayerDesk::open()
        KeptWindow kept = {};                          ///< where the window was before
        MotionWish motion = {};                        ///< performed from the start
    };
    /// A window that shows the stage while something is loaded, and the look that it has.
    struct OpenedWindow {
        engine::Look look;
        engine::WindowLoop window;
    };
    /// Opens the window. Errors: no display, no OpenGL, an unknown theme or camera, an avatar that
    /// cannot be used.
    [[nodiscard]] static Expected<OpenedWindow> open_window(const engine::Settings& settings,
                                                            const Options& options);

    /// `settings` and `setup` must outlive this. `opened`: the window that is open already; none:
    /// it is opened where one is asked for. Errors: those of open_window; an output that cannot be
    /// opened.
    [[nodiscard]] static Expected<std::unique_ptr<StageLoop>> create(
        const engine::Settings& settings,
        const Options& options,
        StageSetup& setup,
        std::optional<OpenedWindow> opened = std::nullopt);
    /// Not copied: actions and window hold references to it.
    StageLoop(const StageLoop&) = delete;
    StageLoop& operator=(const StageLoop&) = delete;  ///< likewise
    ~StageLoop() override;                            ///< finish()

    /// Completes a film that is recorded, and keeps what the window was, once. For an end that does
    /// not come to the destructor.
    void finish();

    /// Runs until the music ends, a person or a signal ends it, or the time is up. `graph` must
    /// outlive the call. Returns why it ended.
    [[nodiscard]] StageEnd run(engine::LiveGraph& graph, const StageSource& source);

    /// What the person asked for when run() ended for a wish; once.
    [[nodiscard]] StageWish take_wish() { return std::exchange(asked_, {}); }
    /// Other dances take the place of those before; between two runs. `setup` must outlive this.
    void adopt(StageSetup& setup);
    /// Why nothing can be shown any more (render::Window::why_lost); empty: it can, or there is no
    /// window. Then run() has ended.
    [[nodiscard]] std::string_view why_lost() const { return window_ ? window_->why_lost() : ""; }
    /// What is kept of the window for the next time.
    [[nodiscard]] KeptWindow& kept() noexcept { return options_.kept; }
    /// Which dance a person has chosen.
    [[nodiscard]] DanceChoice& dance_choice() noexcept { return choice_; }

    /// Between two files: whether a person or a signal has asked for the end.
    [[nodiscard]] bool is_end_wanted();

    /// Prints a line for people on stderr, and shows it over the picture for a while.
    void say(const std::string& line);
    /// Shows it over the picture alone; without a window it does nothing.
    void show(const std::string& line);

 private:
    StageLoop(const engine::Settings& settings, const Options& options, StageSetup& setup);

    void advance(double seconds) override;
    void draw_elsewhere(const engine::WindowView& view) override;
    void draw(const engine::WindowPicture& picture, render::OverlayState& overlay) override;
    void use(render::OverlayControl control, double share) override;
    bool take_dropped(const std::vector<std::string>& paths) override;
    bool take_refused(const Error& why) override;
    [[nodiscard]] bool is_finished() const override;
    [[nodiscard]] bool has_director() const override { return true; }
    [[nodiscard]] render::Camera framed(render::Camera preset) const override;
    void say_told_dance();
    void tell_look(const engine::DancerBodies& bodies);

    // Actions (stage_actions.cpp), lists and what is dropped (stage_requests.cpp).
    void bind(engine::ActionDispatcher& actions);
    void toggle_recording();
    [[nodiscard]] bool is_last_file() const;
    void bind_playing(engine::ActionDispatcher& actions);
    void bind_choices(engine::ActionDispatcher& actions);
    void bind_presets(engine::ActionDispatcher& actions);
    void learn_midi();
    void bind_calm(engine::ActionDispatcher& actions);
    void serve_remote();
    [[nodiscard]] engine::RemoteState state_for_remote();
    [[nodiscard]] engine::RemoteChoices choices_for_remote() const;
    [[nodiscard]] SourceChoice::Means means_of_sources();
    [[nodiscard]] engine::Preset preset_now();
    void take_preset(const engine::Preset& preset);
    void change_told(const std::vector<std::string>& targets);
    void change_outputs(const std::vector<std::string>& targets);
    void say_fault(const Expected<void>& done);
    [[nodiscard]] Expected<void> ask(StageWish wish);
    void play_dropped(const std::vector<Path>& files);
    void learn_dropped(const Path& place);
    void load_clip(const Path& file);
    [[nodiscard]] Expected<void> perform_wished();
    void follow_song();
    void take_loaded();
    void stop_performing();
    [[nodiscard]] const std::string& source_name() const;
    [[nodiscard]] Expected<void> open_pictures(std::optional<OpenedWindow> opened);
    [[nodiscard]] Expected<void> open_studio();
    [[nodiscard]] StageEnd run_until_end(engine::LiveGraph& graph);
    bool run_headless();
    void draw_headless();
    void change_clothes(const engine::ShownMoment& shown);
    void describe(const engine::StageState& stage, render::OverlayState& overlay);
    void describe_targets(render::OverlayState& overlay);
    void describe_song(render::OverlayState& overlay);
    void describe_silence(const engine::StageState& stage, render::OverlayState& overlay);
    [[nodiscard]] DanceChoice::Dancers dancers();
    void keep_dance();
    void say_losses(const engine::LiveCounters& lost) const;
    void toggle_figure_view();
    void go_back();
    void go_on();
    void toggle_pause();
    void seek_to(double seconds);
    void keep_memory();
    [[nodiscard]] bool has_ended() const;
    void carry_over();
    void note_figure(engine::LiveGraph& graph);
    void change_formation();
    void change_bodies();

    const engine::Settings& settings_;
    Options options_;
    std::shared_ptr<const DanceList> dances_;
    engine::Formations* formations_;
    // Without a window, where the pictures go elsewhere. The context lives longest.
    struct Studio {
        render::OffscreenContext context;
        engine::Drawing drawing;
        render::Scene scene;
        std::string camera;
        engine::AvatarChange avatar_change;
    };
    std::optional<Studio> studio_;
    std::unique_ptr<RemoteDesk> remote_;  // what is open in the window may refer to it
    std::optional<engine::WindowLoop> window_;
    std::unique_ptr<VideoShow> video_;           // needs the context of one of both
    ShowRecording recording_;                    // likewise
    std::optional<engine::DressByDance> dress_;  // where avatars are drawn
    bool has_finished_ = false;
    engine::Staging staging_;
    bool is_calm_;
    engine::LiveActions live_actions_;
    std::optional<PlayerDesk> players_;
    std::string playing_;  // what players say, as shown
    std::unique_ptr<engine::Outputs> outputs_;
    std::vector<render::OverlayTarget> targets_;  // of outputs_, as shown
    std::vector<std::uint64_t> lost_before_;      // by each of them, as last asked
    HostTime targets_shown_until_{};              // then they are asked again
    DanceChoice choice_;
    SourceChoice sources_;
    PresetChoice presets_;
    std::string formation_;  // whose distance the camera has
    // What was danced when the last file ended; kept with K, it goes on with the next file.
    DanceId last_dance_ = DanceId::none;
    DanceId told_dance_ = DanceId::none;  // by the file, as last said
    std::string last_figure_;
    // Dropped, and on its way.
    std::optional<Path> dropped_model_;  // one alone, the last
    std::future<Expected<LoadedDance>> learning_;
    std::future<Expected<std::unique_ptr<engine::ClipPerformance>>> clip_loading_;
    std::unique_ptr<engine::ClipPerformance> performance_;  // in the dance's place; or null
    StageWish asked_;
    std::string silence_;  // message while an input is silent
    std::optional<HostTime> silent_since_;
    // While run() runs.
    engine::LiveGraph* graph_ = nullptr;
    const engine::ActionDispatcher* actions_ = nullptr;
    StageSource source_;
    std::optional<StageEnd> wish_;
    bool had_ended_ = false;
    bool has_run_ = false;
    bool has_said_unlocked_ = false;
};

}  // namespace raks::apps
