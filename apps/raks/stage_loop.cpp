#include "apps/raks/stage_loop.hpp"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <span>
#include <utility>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/live_sound.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/locked_memory.hpp"
#include "engine/live/loss_words.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/setup/user_folders.hpp"
#include "render/avatar/avatar.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using DancerKind = motion::DancerCommand::Kind;

// Without a window: time between two looks at the graph.
constexpr Nanos kHeadlessNap = std::chrono::milliseconds(20);
constexpr Nanos kDrawingNap = std::chrono::milliseconds(4);  // or whether a picture is due

// A relative time: nothing here depends on an exact rate.
void nap(Nanos span) {
    timespec time{};
    time.tv_nsec = span.count();
    clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
}

bool is_stop_requested() { return stop_signal().has_value(); }

}  // namespace

Expected<StageLoop::OpenedWindow> StageLoop::open_window(const engine::Settings& settings,
                                                         const Options& options) {
    auto look = open_look(settings);
    if (!look) {
        return fail(look.error());
    }
    render::WindowOptions how;
    how.width = look->size.width;
    how.height = look->size.height;
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
    auto loop = engine::WindowLoop::create(
        std::move(*window),
        *look,
        {.cards = settings.overlay ? engine::Cards::shown : engine::Cards::hidden,
         .say = apps::say,
         .say_detail = say_detail,
         .is_stop_requested = is_stop_requested});
    if (!loop) {
        return fail(loop.error());
    }
    return OpenedWindow{std::move(*look), std::move(*loop)};
}

Expected<std::unique_ptr<StageLoop>> StageLoop::create(const engine::Settings& settings,
                                                       const Options& options,
                                                       StageSetup& setup,
                                                       std::optional<OpenedWindow> opened) {
    auto outputs = engine::Outputs::open(options.outputs);
    if (!outputs) {
        return fail(outputs.error());
    }
    auto remote = RemoteDesk::open(options.remote);
    if (!remote) {
        return fail(remote.error());
    }
    auto players = PlayerDesk::open(options.now_playing);
    if (!players) {
        return fail(players.error());
    }
    std::unique_ptr<StageLoop> loop(new StageLoop(settings, options, setup));
    loop->outputs_ = std::move(*outputs);
    loop->remote_ = std::move(*remote);
    loop->players_ = std::move(*players);
    if (auto done = loop->perform_wished(); !done) {
        return fail(done.error());
    }
    if (auto done = loop->open_pictures(std::move(opened)); !done) {
        return fail(done.error());
    }
    // Not over the picture, which others may see.
    for (const std::string& line : loop->remote_->opening_lines()) {
        apps::say(line);
    }
    return loop;
}

// The window, or where pictures are drawn without one that somebody wants.
Expected<void> StageLoop::open_pictures(std::optional<OpenedWindow> opened) {
    if (!options_.video.wishes.empty() || !options_.video.record.empty()) {
        static_cast<void>(said_film_fps(settings_));
    }
    if (!options_.video.wishes.empty()) {
        auto video = VideoShow::create(options_.video, settings_);
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
    if (options_.is_headless) {
        return open_studio();
    }
    if (!opened) {
        auto window = open_window(settings_, options_);
        if (!window) {
            return fail(window.error());
        }
        opened.emplace(std::move(*window));
    }
    // Until it is solved for the avatar, the dance is retargeted.
    formations_->ask_for_bodies(engine::dance_bodies_of(opened->look.avatars));
    const bool is_transparent = opened->look.scene.backdrop == render::Backdrop::transparent;
    dress_.emplace(opened->look);
    window_.emplace(std::move(opened->window));
    // The quality that the renderer chose by itself.
    if (const std::string notice(window_->notice()); !notice.empty()) {
        say(notice);
    }
    if (is_transparent && !window_->is_transparent()) {
        say("no compositor runs: what is transparent is black in the window");
    }
    return {};
}

// Pictures without a window, where somebody has them. A bad avatar is told even where nobody sees
// it.
Expected<void> StageLoop::open_studio() {
    auto look = open_look(settings_);
    if (!look) {
        return fail(look.error());
    }
    engine::dress_for(*dances_, settings_.dance, *look);
    formations_->ask_for_bodies(engine::dance_bodies_of(look->avatars));
    engine::OutputLook worn{.avatars = {}, .face = look->face};
    for (const engine::LoadedAvatar& avatar : look->avatars) {
        worn.avatars.push_back(avatar.avatar);
    }
    outputs_->wear(worn);
    if (!video_ && !recording_.is_on()) {
        return {};
    }
    auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto drawing = engine::create_drawing(*look);
    if (!drawing) {
        return fail(drawing.error());
    }
    studio_.emplace(
        Studio{std::move(*context),
               std::move(*drawing),
               look->scene,
               look->camera,
               engine::AvatarChange(look->avatars, look->costume, look->most_image_bytes)});
    if (look->partners == engine::Partners::first) {
        studio_->avatar_change.add_partners();
    }
    dress_.emplace(*look);
    return {};
}

StageLoop::StageLoop(const engine::Settings& settings, const Options& options, StageSetup& setup)
    : settings_(settings),
      options_(options),
      dances_(setup.catalogue.list()),
      formations_(&setup.formations),
      recording_(settings_),
      staging_(static_cast<std::uint64_t>(settings.seed),
               settings.calm ? render::Liveliness::calm : render::Liveliness::usual),
      is_calm_(settings.calm),
      live_actions_(static_cast<float>(settings.volume),
                    [this](const std::string& line) { say(line); }),
      choice_(
          settings,
          dances_,
          live_actions_,
          [this] { return dancers(); },
          [this](const std::string& line) { say(line); }),
      sources_(means_of_sources()),
      presets_([this] { return preset_now(); },
               [this](const engine::Preset& preset) { take_preset(preset); },
               [this](const std::string& line) { say(line); }),
      formation_(formations_->name()) {}

void StageLoop::adopt(StageSetup& setup) {
    dances_ = setup.catalogue.list();
    formations_ = &setup.formations;
    choice_.set_dances(dances_);
    last_dance_ = DanceId::none;
    if (window_) {
        formations_->ask_for_bodies(window_->dance_bodies());
    }
}

DanceChoice::Dancers StageLoop::dancers() {
    return {formations_->cast().front().body.repertoire.get(),
            graph_ != nullptr ? graph_->stage().dancer : motion::DancerStatus{}};
}

StageLoop::~StageLoop() { finish(); }

// Where nothing was played, something else was said.
void StageLoop::finish() {
    if (std::exchange(has_finished_, true)) {
        return;
    }
    if (window_) {
        options_.kept.close(*window_);
    }
    const std::string line = recording_.stop(nullptr);
    if (has_run_ && !line.empty()) {
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
    has_run_ = true;
    source_ = source;
    wish_.reset();
    told_dance_ = DanceId::none;
    silent_since_.reset();
    players_->begin_anew();
    staging_.begin_anew();
    if (performance_) {
        performance_->begin_anew();
    }
    if (video_) {
        video_->begin_anew();
    }
    recording_.follow(graph);
    keep_memory();
    outputs_->follow(graph.feed(), dances_);
    const StageEnd end = run_until_end(graph);
    // Nothing is asked of a graph that has gone.
    live_actions_.detach();
    players_->leave(graph);
    graph_ = nullptr;
    source_ = {};
    return end;
}

StageEnd StageLoop::run_until_end(engine::LiveGraph& graph) {
    engine::GraphTarget target(graph);
    engine::ActionDispatcher actions([this](const std::string& line) { say(line); });
    // Volume and latency offset are carried over from the file before.
    live_actions_.attach(target);
    carry_over();
    bind(actions);
    actions_ = &actions;
    remote_->publish(choices_for_remote());
    const bool is_quit =
        window_ ? window_->run(*this, actions) == engine::WindowEnd::quit : run_headless();
    actions_ = nullptr;
    if (is_quit) {
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
    for (std::string& line : outputs_->losses()) {
        lines.push_back(std::move(line));
    }
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

// The same work as with a window, except for pictures. Nobody can quit by it.
bool StageLoop::run_headless() {
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
    return false;
}

// Dance and figure that a person keeps to are not those of one file.
void StageLoop::carry_over() {
    choice_.brief_dancers();
    live_actions_.brief_dancers();
    const motion::Repertoire& repertoire = *formations_->cast().front().body.repertoire;
    const DanceId selected = choice_.selected();
    const DanceId first = selected == DanceId::none ? repertoire.first() : selected;
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
    if (source_.models != nullptr) {
        for (const std::string& line : players_->look(*graph_, *source_.models, *outputs_)) {
            say(line);
        }
    }
    if (video_) {
        for (const std::string& line : video_->take_lines()) {
            say(line);
        }
    }
    if (const auto trouble = recording_.take_trouble()) {
        say(*trouble);
    }
    take_loaded();
    follow_song();
    serve_remote();
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
    const auto change = formations_->poll(dancer.is_dancing ? dancer.dance : DanceId::none);
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
    return window_ && playback != nullptr && is_last_file() && playback->is_finished();
}

// Replaces the dancers by the new formation; what was asked of those before holds for them, too.
void StageLoop::change_formation() {
    if (const auto replaced = graph_->replace_dancers(formations_->cast()); !replaced) {
        say(replaced.error().message);
        return;
    }
    live_actions_.brief_dancers();
    choice_.brief_dancers();
    // Relative to the present distance, so that a person's zoom is kept.
    if (window_) {
        window_->scene().camera.zoom(engine::distance_for(formations_->name()) /
                                     engine::distance_for(formation_));
    }
    formation_ = formations_->name();
    say(fmt::format("dancing: {}", formation_));
}

// The same dance goes on, solved for the bodies that are seen.
void StageLoop::change_bodies() {
    const auto replaced =
        graph_->replace_dancers(formations_->cast(), engine::MotionStage::Entry::onward);
    replaced ? say_detail("the dance fits the avatars that are shown now")
             : say(replaced.error().message);
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

}  // namespace raks::apps
