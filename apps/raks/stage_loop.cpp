#include "apps/raks/stage_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <span>
#include <utility>

#include "apps/raks/dance_setup.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/locked_memory.hpp"
#include "engine/live/loss_words.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/desktop_calm.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/setup/user_folders.hpp"
#include "render/avatar/avatar.hpp"
#include "render/overlay/text_format.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using DancerKind = motion::DancerCommand::Kind;
using engine::Action;

// Without a window: time between two looks at the graph.
constexpr Nanos kHeadlessNap = std::chrono::milliseconds(20);
constexpr Nanos kDrawingNap = std::chrono::milliseconds(4);  // or whether a picture is due
// Up to this many seconds after a file's start, "back" means the file before; later, the start.
constexpr double kStillTheStart = 3.0;

// A relative time: nothing here depends on an exact rate.
void nap(Nanos span) {
    timespec time{};
    time.tv_nsec = span.count();
    clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
}

bool is_stop_requested() { return stop_signal().has_value(); }

// Pictures are calm where the desktop asks for it, unless the person has said what they shall be.
void follow_desktop(engine::Settings& settings) {
    const engine::SettingRank rank = engine::origin_of(settings, &engine::Settings::calm).rank;
    if (rank < engine::SettingRank::config && !settings.calm && engine::desktop_asks_for_calm()) {
        settings.calm = true;
        say_detail("the desktop asks for calm pictures (--no-calm: the usual ones)");
    }
}

// Errors: no display, or no OpenGL.
Expected<engine::WindowLoop> open_window(const engine::Settings& settings,
                                         const engine::Look& look,
                                         const StageLoop::Options& options) {
    render::WindowOptions how;
    how.width = look.size.width;
    how.height = look.size.height;
    how.is_fullscreen = options.window.is_fullscreen;
    how.is_transparent = true;
    how.is_borderless = options.window.is_borderless;
    how.is_on_top = options.window.is_on_top;
    how.max_fps = settings.fps;
    // A film that is recorded is completed then.
    how.outlives_loss = true;
    options.kept.place(how);
    auto window = render::Window::create(how);
    if (!window) {
        return fail(window.error());
    }
    return engine::WindowLoop::create(
        std::move(*window),
        look,
        {.cards = settings.overlay ? engine::Cards::shown : engine::Cards::hidden,
         .say = apps::say,
         .say_detail = say_detail,
         .is_stop_requested = is_stop_requested});
}

}  // namespace

// 20 characters from -60 to 0 dBFS.
std::string level_meter(float dbfs) {
    constexpr int kWidth = 20;
    const auto bars = static_cast<std::size_t>(std::lround(render::meter_fraction(dbfs) * kWidth));
    return fmt::format("[{:<{}}] {:6.1f} dBFS", std::string(bars, '#'), kWidth, dbfs);
}

Expected<std::unique_ptr<StageLoop>> StageLoop::create(const engine::Settings& given,
                                                       const Options& options,
                                                       std::shared_ptr<const DanceList> dances,
                                                       engine::Formations& formations) {
    engine::Settings settings = given;
    if (!options.is_headless) {
        follow_desktop(settings);
    }
    const auto look = open_look(settings);
    if (!look) {
        return fail(look.error());
    }
    auto outputs = engine::Outputs::open(options.outputs);
    if (!outputs) {
        return fail(outputs.error());
    }
    // Until it is solved for the avatar, the dance is retargeted.
    formations.ask_for_bodies(engine::dance_bodies_of(look->avatars));
    std::unique_ptr<StageLoop> loop(
        new StageLoop(settings, options, std::move(dances), formations));
    loop->outputs_ = std::move(*outputs);
    if (auto opened = loop->open_pictures(*look); !opened) {
        return fail(opened.error());
    }
    return loop;
}

// The window, or where pictures are drawn without one that somebody wants.
Expected<void> StageLoop::open_pictures(const engine::Look& look) {
    if (!options_.video.wishes.empty() || !options_.video.record.empty()) {
        static_cast<void>(said_film_fps(settings_));
    }
    if (!options_.video.wishes.empty()) {
        auto video = VideoShow::create(options_.video, settings_, dances_);
        if (!video) {
            return fail(video.error());
        }
        video_ = std::move(*video);
    }
    if (!options_.video.record.empty()) {
        if (auto started = recording_.start(options_.video.record); !started) {
            return started;
        }
    }
    if (!options_.is_headless) {
        auto window = open_window(settings_, look, options_);
        if (!window) {
            return fail(window.error());
        }
        window_.emplace(std::move(*window));
        // The quality that the renderer chose by itself.
        if (const std::string notice(window_->notice()); !notice.empty()) {
            say(notice);
        }
        if (look.scene.backdrop == render::Backdrop::transparent && !window_->is_transparent()) {
            say("no compositor runs: what is transparent is black in the window");
        }
    } else if (video_ || recording_.is_on()) {
        auto context = render::OffscreenContext::create();
        if (!context) {
            return fail(context.error());
        }
        auto drawing = engine::create_drawing(look);
        if (!drawing) {
            return fail(drawing.error());
        }
        studio_.emplace(Studio{std::move(*context), std::move(*drawing), look.scene, look.camera});
    }
    return {};
}

StageLoop::StageLoop(const engine::Settings& settings,
                     const Options& options,
                     std::shared_ptr<const DanceList> dances,
                     engine::Formations& formations)
    : settings_(settings),
      options_(options),
      dances_(std::move(dances)),
      formations_(formations),
      recording_(settings_, dances_),
      staging_(static_cast<std::uint64_t>(settings.seed),
               settings.calm ? render::Liveliness::calm : render::Liveliness::usual),
      live_actions_(static_cast<float>(settings.volume),
                    [this](const std::string& line) { say(line); }),
      formation_(formations.name()) {}

// The graph has gone before. Where nothing was played, something else was said.
StageLoop::~StageLoop() {
    if (window_) {
        options_.kept.close(*window_);
    }
    const std::string line = recording_.stop(nullptr);
    if (graph_ != nullptr && !line.empty()) {
        say(line);
    }
}

bool StageLoop::is_end_wanted() {
    return is_stop_requested() || (window_ && window_->is_end_wanted());
}

void StageLoop::say(const std::string& line) {
    if (window_) {
        window_->say(line);
    } else {
        apps::say(line);
    }
}

void StageLoop::show(const std::string& line) {
    if (window_) {
        window_->show(line);
    }
}

// What the threads of the graph use is all there now.
void StageLoop::keep_memory() {
    if (const auto locked = lock_memory(); !locked && !has_said_unlocked_) {
        has_said_unlocked_ = true;
        say_detail(locked.error().message);
    }
}

// Actions are bound anew for each file, as they act on its graph.
StageEnd StageLoop::run(engine::LiveGraph& graph, const StageSource& source) {
    graph_ = &graph;
    source_ = source;
    wish_.reset();
    told_dance_ = DanceId::none;
    staging_.begin_anew();
    if (video_) {
        video_->begin_anew();
    }
    recording_.follow(graph);
    keep_memory();
    outputs_->follow(graph.feed());
    engine::GraphTarget target(graph);
    engine::ActionDispatcher actions([this](const std::string& line) { say(line); });
    // Volume and latency offset are carried over from the file before.
    live_actions_.attach(target);
    carry_over();
    bind(actions);
    if (!window_) {
        run_headless();
    } else if (window_->run(*this, actions) == engine::WindowEnd::quit) {
        return StageEnd::quit;
    }
    note_figure(graph);
    say_losses(graph.counters());
    // A signal also ends the list of files.
    if (is_stop_requested()) {
        return StageEnd::quit;
    }
    return wish_.value_or(StageEnd::finished);
}

// With a window the overlay counts them.
void StageLoop::say_losses(const engine::LiveCounters& lost) const {
    std::vector<std::string> lines = video_ ? video_->losses() : std::vector<std::string>();
    if (const std::string words = engine::losses_in_words(lost); !words.empty()) {
        lines.push_back("while it ran: " + words);
    }
    for (const std::string& line : lines) {
        window_ ? say_detail(line) : apps::say(line);
    }
}

// The file, or the device that is listened to now: the server may move it.
const std::string& StageLoop::source_name() const {
    return graph_->playback() != nullptr ? source_.name : graph_->device().name;
}

// The same work as with a window, except for pictures.
void StageLoop::run_headless() {
    ProgressLine status(source_name());
    while (!is_stop_requested() && !is_finished()) {
        advance(0.0);
        status.rename(source_name() + (graph_->trouble().empty() ? "" : " (the device is gone)"));
        status.show(fmt::format("{} {:5.1f} BPM",
                                level_meter(graph_->analysis().level_dbfs(HostClock::now())),
                                graph_->stage().music.grid.tempo.bpm()));
        draw_headless();
        nap(studio_ ? kDrawingNap : kHeadlessNap);
    }
}

void StageLoop::draw_headless() {
    if (studio_) {
        const render::Camera preset = framed(
            engine::camera_for(engine::preset_of(studio_->camera), studio_->drawing.bodies.size()));
        draw_elsewhere({studio_->drawing, studio_->scene, {studio_->camera, preset}});
    }
}

void StageLoop::draw_elsewhere(const engine::WindowView& view) {
    if (video_) {
        video_->draw(*graph_, view, [this](render::OverlayState& overlay) {
            describe(graph_->stage(), overlay);
        });
    }
    FilmedStage::Describe describes;
    if (options_.video.has_overlay) {
        describes = [this](render::OverlayState& overlay) { describe(graph_->stage(), overlay); };
    }
    if (const auto drawn = recording_.draw(*graph_, view, describes); !drawn) {
        say("recording ended: " + drawn.error().message);
    }
}

void StageLoop::toggle_recording() {
    if (recording_.is_on()) {
        say(recording_.stop(graph_));
        return;
    }
    const Path file = engine::dated_file(engine::videos_folder(), ".mp4");
    if (const auto started = recording_.start(file); !started) {
        say(started.error().message);
        return;
    }
    recording_.follow(*graph_);
    say("recording " + file.string() + " (F9: stop)");
}

// Actions of this class, beside those of LiveActions and of the window.
void StageLoop::bind(engine::ActionDispatcher& actions) {
    live_actions_.bind(actions);
    bind_playing(actions);
    actions.on(Action::next_dance, [this](double) { select_next_dance(); });
    actions.on(Action::keep_dance, [this](double) { keep_dance(); });
    actions.on(Action::next_formation, [this](double) { ask_for_next_formation(); });
    actions.on(Action::toggle_figure_view, [this](double) { toggle_figure_view(); });
    if (window_) {
        actions.on(Action::record, [this](double) { toggle_recording(); });
    }
}

// What a file has, and not an input.
void StageLoop::bind_playing(engine::ActionDispatcher& actions) {
    engine::Playback* const playback = graph_->playback();
    if (playback == nullptr) {
        return;
    }
    actions.on(Action::next_file, [this](double) { go_on(); });
    actions.on(Action::previous_file, [this](double) { go_back(); });
    actions.on(Action::pause, [this](double) { toggle_pause(); });
    if (!playback->player().can_seek()) {
        actions.on(Action::seek,
                   [this](double) { say("sound from a pipe cannot go back or ahead"); });
    }
}

// Dance and figure that a person keeps to are not those of one file.
void StageLoop::carry_over() {
    repeat_selected_dance();
    live_actions_.brief_dancers();
    const motion::Repertoire& repertoire = *formations_.cast().front().body.repertoire;
    const DanceId first = selected_dance_ == DanceId::none ? repertoire.first() : selected_dance_;
    // Another dance has other figures.
    const motion::DanceLibrary* const dance =
        first == last_dance_ ? repertoire.of(last_dance_) : nullptr;
    if (!live_actions_.keeps_figure() || dance == nullptr) {
        return;
    }
    const std::vector<std::string_view> names = dance->figure_names();
    const auto figure = std::find(names.begin(), names.end(), last_figure_);
    if (figure != names.end()) {
        live_actions_.ask(DancerKind::select_figure, static_cast<double>(figure - names.begin()));
    }
}

void StageLoop::note_figure(engine::LiveGraph& graph) {
    const motion::DancerStatus& dancer = graph.stage().dancer;
    if (dancer.is_dancing) {
        last_dance_ = dancer.dance;
        last_figure_ =
            std::string(dancer.figure.data(), strnlen(dancer.figure.data(), dancer.figure.size()));
    }
}

// With every picture: is the device alive, and is a formation ready?
void StageLoop::advance(double /*seconds*/) {
    for (const std::string& line : graph_->watch(HostClock::now())) {
        say(line);
    }
    for (const std::string& line : outputs_->take_lines()) {
        say(line);
    }
    if (video_) {
        for (const std::string& line : video_->take_lines()) {
            say(line);
        }
    }
    if (const auto trouble = recording_.take_trouble()) {
        say(*trouble);
    }
    if (source_.each_picture) {
        source_.each_picture();
    }
    if (window_) {
        follow_stage(staging_, graph_->stage());
    }
    say_told_dance();
    if (const bool had_ended = std::exchange(had_ended_, has_ended()); had_ended_ && !had_ended) {
        say_detail("at the end of the last file");
    }
    const motion::DancerStatus& dancer = graph_->stage().dancer;
    const auto change = formations_.poll(dancer.is_dancing ? dancer.dance : DanceId::none);
    if (!change) {
        say(change.error().message);
    } else if (*change == engine::Formations::Change::formation) {
        change_formation();
    } else if (*change == engine::Formations::Change::bodies) {
        change_bodies();
    }
}

bool StageLoop::is_finished() const {
    if (wish_) {
        return true;
    }
    // Up to what leaves the loudspeaker, not up to what was handed over.
    const StreamTime audible = graph_->moment_at(HostClock::now());
    if (options_.seconds && to_seconds(audible) >= *options_.seconds) {
        return true;
    }
    const engine::Playback* const playback = graph_->playback();
    return playback != nullptr && graph_->is_played_out(HostClock::now()) && !has_ended();
}

// At the end of the last file a window stays.
bool StageLoop::has_ended() const {
    const engine::Playback* const playback = graph_->playback();
    return window_ && source_.behind == StageSource::Behind::stay && playback != nullptr &&
           playback->is_finished();
}

void StageLoop::go_on() {
    if (window_ && source_.behind == StageSource::Behind::stay) {
        say("there is no file after this one (Q quits)");
    } else {
        wish_ = StageEnd::next_file;
    }
}

// A file that has ended plays again.
void StageLoop::toggle_pause() {
    engine::Playback& playback = *graph_->playback();
    if (has_ended() && playback.player().can_seek()) {
        playback.set_paused(false);
        playback.seek(source_.start);
    } else {
        playback.set_paused(!playback.is_paused());
        say_detail(playback.is_paused() ? "paused" : "playing on");
    }
}

void StageLoop::seek_to(double seconds) {
    if (engine::Playback* const playback = graph_->playback()) {
        playback->seek(std::max(seconds, source_.start));
    }
}

// What is clicked or dragged in the overlay.
void StageLoop::use(render::OverlayControl control, double share) {
    if (graph_->playback() == nullptr) {
        return;
    }
    if (control == render::OverlayControl::play_sign) {
        toggle_pause();
    } else if (source_.duration) {
        seek_to(share * *source_.duration);
    }
}

// Goes back to the start of the section or, when it is close, to the file before.
void StageLoop::go_back() {
    engine::Playback& playback = *graph_->playback();
    const bool is_far_in = playback.position_seconds() - source_.start > kStillTheStart;
    if ((is_far_in || has_ended()) && playback.player().can_seek()) {
        playback.seek(source_.start);
    } else {
        wish_ = StageEnd::previous_file;
    }
}

void StageLoop::toggle_figure_view() {
    render::View& view = window_->scene().view;
    view = view == render::View::skin ? render::View::stick : render::View::skin;
}

// Selects the next dance of the list; after the last, the dance that is recognised again.
void StageLoop::select_next_dance() {
    if (settings_.dance != "auto") {
        say(fmt::format("only {} is danced, as asked for: start without --dance for the others",
                        settings_.dance));
        return;
    }
    const bool is_recognized = selected_dance_ == DanceId::none;
    const std::size_t next = is_recognized ? 0 : index_of(selected_dance_) + 1;
    selected_dance_ = next < dances_->size() ? static_cast<DanceId>(next) : DanceId::none;
    live_actions_.ask(DancerKind::select_dance, static_cast<double>(selected_dance_));
    const motion::DancerStatus& dancer = graph_->stage().dancer;
    const bool is_danced_already = dancer.is_dancing && dancer.dance == selected_dance_;
    say(engine::chosen_dance_line(
        selected_dance_ == DanceId::none ? "" : dances_->name_of(selected_dance_),
        is_danced_already));
}

// The dance that was chosen by D or by the settings, for whenever this song is played.
void StageLoop::keep_dance() {
    if (!source_.keep_dance) {
        say("no dance is kept: what is heard is no file that could be found again");
        return;
    }
    const bool is_asked_for = settings_.dance != "auto";
    say(source_.keep_dance(selected_dance_ != DanceId::none ? dances_->name_of(selected_dance_)
                           : is_asked_for                   ? std::string_view(settings_.dance)
                                                            : std::string_view()));
}

// Dancers who replaced others start with the recognised dance and must be told the selected one.
void StageLoop::repeat_selected_dance() {
    if (selected_dance_ != DanceId::none) {
        live_actions_.ask(DancerKind::select_dance, static_cast<double>(selected_dance_));
    }
}

void StageLoop::ask_for_next_formation() {
    say(fmt::format("formation {} (E: another one)", formations_.ask_for_next()));
}

// Replaces the dancers by the new formation; what was asked of those before holds for them, too.
void StageLoop::change_formation() {
    if (const auto replaced = graph_->replace_dancers(formations_.cast()); !replaced) {
        say(replaced.error().message);
        return;
    }
    live_actions_.brief_dancers();
    repeat_selected_dance();
    // Relative to the present distance, so that a person's zoom is kept.
    if (window_) {
        window_->scene().camera.zoom(engine::distance_for(formations_.name()) /
                                     engine::distance_for(formation_));
    }
    formation_ = formations_.name();
    say(fmt::format("dancing: {}", formation_));
}

// The same dance goes on, solved for the bodies that are seen.
void StageLoop::change_bodies() {
    const auto replaced =
        graph_->replace_dancers(formations_.cast(), engine::MotionStage::Entry::onward);
    replaced ? say_detail("the dance fits the avatars that are shown now")
             : say(replaced.error().message);
}

// A camera preset is made for one or two dancers.
render::Camera StageLoop::framed(render::Camera preset) const {
    preset.zoom(engine::distance_for(formation_));
    return preset;
}

// Once for a dance of a song, when the person's or the file's words decide for it; the overlay
// shows it, too.
void StageLoop::say_told_dance() {
    const MusicState& music = graph_->stage().music;
    if (music.is_genre_told && music.genre != told_dance_) {
        told_dance_ = music.genre;
        apps::say(fmt::format("{}, {}", dances_->name_of(music.genre), source_.teller));
    }
}

// One stage and one moment for all dancers: they must not be drawn at different times.
void StageLoop::draw(const engine::WindowPicture& picture, render::OverlayState& overlay) {
    // Whoever is seen: an avatar may have been taken over meanwhile.
    formations_.ask_for_bodies(picture.bodies.dance_bodies());
    const engine::StageState& stage = graph_->stage();
    const StreamTime moment = graph_->moment_at(picture.seen_at);
    const engine::ShownMoment shown = shown_moment(stage, moment);
    staging_.set_picture(
        static_cast<float>(picture.target.width) / static_cast<float>(picture.target.height),
        picture.bodies.size());
    follow_stage(staging_, stage);
    staging_.set(picture.scene, picture.camera, {.time = moment}, shown.danced.tracks);
    draw_moment(shown, picture.renderer, picture.bodies, picture.scene, picture.target);
    describe_moment(shown, *dances_, overlay);
    describe(stage, overlay);
}

// The parts of the overlay that a moment does not know: source, place, latency and counters.
void StageLoop::describe(const engine::StageState& stage, render::OverlayState& overlay) {
    if (has_ended()) {
        overlay.message = graph_->playback()->player().can_seek()
                              ? "the end   (Space: once more, Q: quit)"
                              : "the end   (Q: quit)";
    }
    if (!graph_->trouble().empty()) {
        // Stays as long as it is so. Nothing is heard, so that no music state says the level.
        overlay.message = graph_->trouble();
        overlay.level_dbfs = graph_->analysis().level_dbfs(HostClock::now());
    }
    overlay.source = source_name();
    overlay.genre_teller = source_.teller;
    overlay.has_keys = true;
    overlay.duration = source_.duration;
    if (const engine::Playback* const playback = graph_->playback()) {
        overlay.position = playback->position_seconds();
        overlay.is_paused = playback->is_paused() || has_ended();
        overlay.volume = live_actions_.volume();
        overlay.latency_ms = to_seconds(graph_->heard_after()) * 1e3;
        // With an input the latency is that of the analysis: nothing is played.
    } else {
        overlay.latency_ms = to_seconds(graph_->analysis().taken_until() - stage.music.time) * 1e3;
    }
    const engine::LiveCounters counters = graph_->counters();
    overlay.drops = counters.dropped_states;
    overlay.xruns = counters.xruns;
    overlay.late = counters.underruns;
}

engine::LiveGraphConfig sound_config(const engine::Settings& settings) {
    engine::LiveGraphConfig config;
    config.buffer_seconds = settings.buffer_ms * 1e-3;
    config.latency_offset = nanos_from_seconds(settings.latency_offset_ms * 1e-3);
    config.pose_lead = nanos_from_seconds(settings.pose_lead_ms * 1e-3);
    if (auto offsets = engine::DeviceOffsets::load()) {
        config.offsets = std::move(*offsets);
    } else {
        complain(offsets.error().message + "; no device's offset is used");
    }
    return config;
}

}  // namespace raks::apps
