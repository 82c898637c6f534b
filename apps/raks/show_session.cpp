#include "apps/raks/show_session.hpp"

#include <future>
#include <utility>
#include <vector>

#include "apps/raks/live_sound.hpp"
#include "apps/raks/opening_content.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "engine/offline/music_source.hpp"
#include "engine/setup/desktop_calm.hpp"
#include "engine/setup/play_list.hpp"
#include "engine/setup/settings_table.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// The files to play; when none are given, music that Raks makes. Errors: none of those that are
// given can be played.
Expected<engine::PlayList> files_to_play(const std::vector<Path>& given) {
    if (!given.empty()) {
        return engine::read_play_list(given);
    }
    const EndAtOnceOnSignals at_once;
    const auto demo = engine::demo_music();
    if (!demo) {
        return fail(demo.error());
    }
    return engine::PlayList{{*demo}, {}};
}

}  // namespace

ShowSession::ShowSession(PlayArguments arguments, std::optional<double> listens_for)
    : arguments_(std::move(arguments)),
      listens_for_(listens_for),
      // All dances are loaded, as people may allow them in the window.
      forbidden_(std::exchange(arguments_.settings.forbidden_dances, {})) {}

// Whether there is anything to play, and where, is said before a window opens.
ExitCode ShowSession::play() {
    if (auto chosen = choose_files(arguments_.files); !chosen) {
        return fail(chosen.error());
    }
    recall_window();
    if (auto chosen = choose_output(); !chosen) {
        return fail(chosen.error().message + " (--no-sound dances without a loudspeaker)");
    }
    if (auto set = set_stage(); !set) {
        return fail(set.error());
    }
    return run();
}

// The input first: without one there is nothing to dance to.
ExitCode ShowSession::live() {
    recall_window();
    if (auto chosen = choose_input(); !chosen) {
        return fail(chosen.error());
    }
    if (auto set = set_stage(); !set) {
        return fail(set.error());
    }
    return run();
}

// The window first: whoever clicked an icon sees that something happens.
ExitCode ShowSession::open() {
    recall_window();
    const auto is_set = set_stage_in_window();
    if (!is_set) {
        return fail(is_set.error());
    }
    if (!*is_set) {
        return kExitDone;
    }
    if (auto chosen = listen_or_play_own(); !chosen) {
        return fail(chosen.error());
    }
    return run();
}

// Where there is nothing to listen to, the dancer dances to music of its own.
Expected<void> ShowSession::listen_or_play_own() {
    if (arguments_.files.empty()) {
        auto chosen = choose_input();
        if (chosen || !arguments_.settings.device.empty()) {
            return chosen;
        }
        why_own_music_ = "music of its own: " + chosen.error().message;
    }
    if (auto chosen = choose_files(arguments_.files); !chosen) {
        return chosen;
    }
    if (auto chosen = choose_output(); !chosen) {
        why_own_music_ += why_own_music_.empty() ? "without sound: " + chosen.error().message : "";
        output_.reset();
        has_output_ = true;
    }
    return {};
}

Expected<audio::AudioSystem*> ShowSession::system() {
    auto opened =
        audio::AudioSystem::open(audio::audio_system_of(arguments_.settings.audio_system));
    if (!opened) {
        return fail(opened.error());
    }
    // The new one is there before the old one goes, so that libraries stay initialized.
    system_ = std::move(*opened);
    return &*system_;
}

Expected<void> ShowSession::choose_files(const std::vector<Path>& given) {
    auto list = files_to_play(given);
    if (!list) {
        return fail(list.error());
    }
    auto files = std::make_unique<PlaySet>(std::move(*list), arguments_);
    if (auto begun = files->begin(); !begun) {
        return begun;
    }
    files_ = std::move(files);
    return {};
}

Expected<void> ShowSession::choose_input() {
    const auto found = system();
    if (!found) {
        return fail(found.error());
    }
    auto choice = input_of(**found, arguments_.settings);
    if (!choice) {
        return fail(choice.error());
    }
    input_ = std::move(*choice);
    is_input_named_ = !arguments_.settings.device.empty();
    return {};
}

// Without sound no audio system is opened, so that none is needed.
Expected<void> ShowSession::choose_output() {
    has_output_ = true;
    if (arguments_.is_soundless) {
        return {};
    }
    const auto found = system();
    if (!found) {
        return fail(found.error());
    }
    auto choice = output_of(**found, arguments_.settings);
    if (!choice) {
        return fail(choice.error());
    }
    say("sound goes to " + choice->reason);
    output_ = std::move(choice->device);
    return {};
}

Expected<void> ShowSession::set_stage() {
    auto setup = open_formations(arguments_.settings);
    if (!setup) {
        return fail(setup.error());
    }
    setup_ = std::make_shared<StageSetup>(std::move(*setup));
    auto loop = StageLoop::create(arguments_.settings, stage_options(), *setup_);
    if (!loop) {
        return fail(loop.error());
    }
    loop_ = std::move(*loop);
    loop_->dance_choice().forbid_only(forbidden_);
    return {};
}

StageLoop::Options ShowSession::stage_options() const {
    return {arguments_.is_headless,
            arguments_.window,
            listens_for_,
            arguments_.outputs,
            arguments_.video,
            arguments_.remote,
            arguments_.now_playing,
            kept_,
            arguments_.motion};
}

// Where a window opens, what it was before counts, and what the desktop asks for.
void ShowSession::recall_window() {
    if (arguments_.is_headless) {
        return;
    }
    engine::Settings& settings = arguments_.settings;
    kept_ = KeptWindow::recall(settings);
    const engine::SettingRank rank = engine::origin_of(settings, &engine::Settings::calm).rank;
    if (rank < engine::SettingRank::config && !settings.calm && engine::desktop_asks_for_calm()) {
        settings.calm = true;
        say_detail("the desktop asks for calm pictures (--no-calm: the usual ones)");
    }
}

// The window shows the stage while the dances are loaded. False: it was closed meanwhile.
Expected<bool> ShowSession::set_stage_in_window() {
    auto opened = StageLoop::open_window(arguments_.settings, stage_options());
    if (!opened) {
        return fail(opened.error());
    }
    engine::Settings settings = arguments_.settings;
    std::future<Expected<StageSetup>> loading;
    // Asked for the first time when the first picture is seen, which shall not wait for the dances.
    const bool is_open = show_opening(opened->window, [&] {
        if (!loading.valid()) {
            loading =
                std::async(std::launch::async, [&settings] { return load_formations(settings); });
        }
        return loading.wait_for(Nanos(0)) == std::future_status::ready;
    });
    if (!is_open) {
        return false;
    }
    auto setup = loading.get();
    if (!setup) {
        return fail(setup.error());
    }
    arguments_.settings = settings;
    setup_ = std::make_shared<StageSetup>(std::move(*setup));
    auto loop =
        StageLoop::create(arguments_.settings, stage_options(), *setup_, std::move(*opened));
    if (!loop) {
        return fail(loop.error());
    }
    loop_ = std::move(*loop);
    loop_->dance_choice().forbid_only(forbidden_);
    return true;
}

ExitCode ShowSession::run() {
    for (;;) {
        const auto has_wish = files_ ? play_files() : listen();
        if (const auto why = loop_->why_lost(); !why.empty()) {
            return fail(std::string(why));
        }
        if (!has_wish) {
            return fail(has_wish.error());
        }
        if (!*has_wish) {
            break;
        }
        carry_out(loop_->take_wish());
    }
    if (files_) {
        say_skipped(*files_);
    }
    loop_->finish();
    // A signal does not wait for dances that are still being solved.
    const EndAtOnceOnSignals at_once;
    // Dances that were left out meanwhile.
    for (const std::string& line : setup_->formations.wait()) {
        loop_->say(line);
    }
    return has_failed_ ? kExitFailed : was_partly_ ? kExitPartly : kExitDone;
}

// Errors: nothing could be played.
Expected<bool> ShowSession::play_files() {
    read_corrections(setup_->models);
    if (!why_own_music_.empty()) {
        loop_->say(std::exchange(why_own_music_, {}));
    }
    SongPlayer player({arguments_, output_, setup_->models, setup_->formations, *loop_});
    const SongPlayer::End end = player.play(*files_, std::exchange(place_, std::nullopt));
    has_failed_ = has_failed_ || player.has_failed();
    has_played_ = has_played_ || player.has_played();
    if (!has_played_) {
        return fail(nothing_played(files_->skipped()));
    }
    place_ = player.place();
    return end == SongPlayer::End::wish;
}

Expected<std::unique_ptr<engine::LiveGraph>> ShowSession::open_input() const {
    engine::LiveGraphConfig config = sound_config(arguments_.settings);
    config.models = setup_->models;
    config.cast = setup_->formations.cast();
    config.is_device_named = is_input_named_;
    return engine::LiveGraph::listen(input_->device, config);
}

// Errors: the input cannot be opened.
Expected<bool> ShowSession::listen() {
    auto graph =
        opened_ ? Expected<std::unique_ptr<engine::LiveGraph>>(std::move(opened_)) : open_input();
    if (!graph) {
        return fail(graph.error());
    }
    has_played_ = true;
    loop_->say("listening to " + input_->reason);
    StageSource source;
    source.teller = "as the player says";
    source.models = &setup_->models;
    const StageEnd end = loop_->run(**graph, source);
    has_failed_ = (*graph)->has_lost_device();
    if (end == StageEnd::wish) {
        return true;
    }
    // A last line with what the tracker had found, also for headless runs.
    const BeatGrid grid = (*graph)->stage().music.grid;
    say(fmt::format("tempo {:.1f} BPM, confidence {:.2f}, level {}",
                    grid.tempo.bpm(),
                    grid.confidence,
                    level_meter((*graph)->analysis().level_dbfs(HostClock::now()))));
    return false;
}

// What cannot be done is said, and the show goes on as it was.
void ShowSession::carry_out(StageWish wish) {
    Expected<void> done;
    switch (wish.kind) {
        case StageWish::Kind::music:
            done = change_music(wish.files);
            break;
        case StageWish::Kind::input:
            done = change_input(wish.name);
            break;
        case StageWish::Kind::output:
            done = change_output(wish.name);
            break;
        case StageWish::Kind::dances:
            change_dances(std::move(wish));
            break;
    }
    if (!done) {
        loop_->say(done.error().message);
    }
}

Expected<void> ShowSession::change_music(const std::vector<Path>& files) {
    if (!has_output_) {
        if (auto chosen = choose_output(); !chosen) {
            loop_->say(chosen.error().message + ": it plays without sound");
        }
    }
    std::unique_ptr<PlaySet> before = std::move(files_);
    auto chosen = choose_files(files);
    if (!chosen) {
        files_ = std::move(before);
        return chosen;
    }
    if (before) {
        say_skipped(*before);
    }
    place_.reset();
    return {};
}

Expected<void> ShowSession::change_input(const std::string& name) {
    const auto before = input_;
    const std::string wanted = std::exchange(arguments_.settings.device, name);
    if (auto chosen = choose_input(); !chosen) {
        arguments_.settings.device = wanted;
        return chosen;
    }
    // It may be there and refuse to be opened: then the show goes on with what it had.
    auto graph = open_input();
    if (!graph) {
        input_ = before;
        arguments_.settings.device = wanted;
        return fail(graph.error());
    }
    opened_ = std::move(*graph);
    loop_->kept().choose_device(input_->device.name);
    if (files_) {
        say_skipped(*files_);
        files_.reset();
    }
    return {};
}

Expected<void> ShowSession::change_output(const std::string& name) {
    if (arguments_.is_soundless) {
        return fail("it plays without sound, as asked for: start without --no-sound");
    }
    const std::string wanted = std::exchange(arguments_.settings.output, name);
    if (auto chosen = choose_output(); !chosen) {
        arguments_.settings.output = wanted;
        return chosen;
    }
    loop_->kept().choose_output(output_->name);
    if (!files_) {
        loop_->say("music that is dropped here plays on " + name);
    }
    return {};
}

// The graph of the music before is gone; its dancers went with it.
void ShowSession::change_dances(StageWish wish) {
    arguments_.settings.dance = "auto";
    loop_->adopt(*wish.setup);
    setup_ = std::move(wish.setup);
    if (auto selected = loop_->dance_choice().select(wish.name); !selected) {
        loop_->say(selected.error().message);
    }
}

void ShowSession::say_skipped(const PlaySet& files) {
    for (const std::string& line : files.skipped().report()) {
        complain(line);
    }
    was_partly_ = was_partly_ || files.skipped().count() > 0;
}

}  // namespace raks::apps
