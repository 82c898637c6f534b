// `raks live --no-avatar`: listens, and tells others what the music does. Nobody dances.
#include <algorithm>
#include <utility>

#include "apps/raks/commands.hpp"
#include "apps/raks/kept_window.hpp"
#include "apps/raks/live_sound.hpp"
#include "apps/raks/player_desk.hpp"
#include "apps/raks/remote_desk.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/locked_memory.hpp"
#include "base/sleep_until.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "engine/control/live_actions.hpp"
#include "engine/live/live_graph.hpp"
#include "engine/outputs/outputs.hpp"
#include "engine/setup/dance_catalogue.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr Nanos kServerNap = std::chrono::milliseconds(100);
constexpr Nanos kRemoteNap = std::chrono::milliseconds(20);  // where somebody may ask or say

// No tagger: it is for people's choice of a dance, and large.
Expected<engine::AnalyzerModels> load_ears(engine::FileTags tags) {
    const EndAtOnceOnSignals at_once;
    const auto catalogue = engine::DanceCatalogue::load();
    if (!catalogue) {
        return fail(catalogue.error());
    }
    return engine::load_analyzer_models(catalogue->list(), {engine::TaggerUse::off, tags});
}

// What can be asked for where nobody dances: all that is of the tempo.
void serve_beats(engine::LiveGraph& graph,
                 engine::Outputs& outputs,
                 RemoteDesk& remote,
                 PlayerDesk& players,
                 const engine::AnalyzerModels& models,
                 std::optional<double> seconds) {
    engine::GraphTarget target(graph);
    engine::LiveActions live(1.0F, say);
    engine::ActionDispatcher actions(say);
    live.attach(target);
    live.bind(actions);
    ProgressLine status(graph.device().name);
    const HostTime start = HostClock::now();
    for (HostTime now = start; !stop_signal();) {
        for (const std::string& line : graph.watch(now)) {
            say(line);
        }
        for (const std::string& line : outputs.take_lines()) {
            say(line);
        }
        for (const std::string& line : remote.carry_out(actions)) {
            say(line);
        }
        for (const std::string& line : players.look(graph, models, outputs)) {
            say(line);
        }
        const MusicState& music = graph.newest_music();
        if (const auto line = remote.follow_link(graph, music)) {
            say(*line);
        }
        if (remote.wants_state(now)) {
            engine::RemoteState state = heard_state(graph, music, outputs, *models.dances);
            state.song = players.song();
            remote.publish(state);
        }
        status.rename(graph.device().name +
                      (graph.trouble().empty() ? "" : " (the device is gone)"));
        status.show(fmt::format("{} {:5.1f} BPM",
                                level_meter(graph.analysis().level_dbfs(now)),
                                music.grid.tempo.bpm()));
        if (seconds && to_seconds(graph.moment_at(now)) >= *seconds) {
            break;
        }
        now += remote.is_open() || players.listens(graph) ? kRemoteNap : kServerNap;
        sleep_until(now);
        now = std::max(now, HostClock::now());
    }
}

}  // namespace

ExitCode serve_beats(const LiveArguments& arguments) {
    for (const engine::OutputWish& wish : arguments.outputs) {
        if (wish.kind->needs_dancers) {
            complain(
                fmt::format("--no-avatar: nobody dances, and --{} tells how somebody does; "
                            "leave one of them out",
                            wish.kind->option));
            return kExitUsage;
        }
    }
    engine::Settings settings = arguments.settings;
    auto outputs = engine::Outputs::open(arguments.outputs);
    if (!outputs) {
        return fail(outputs.error());
    }
    auto remote = RemoteDesk::open(arguments.remote);
    if (!remote) {
        return fail(remote.error());
    }
    auto players = PlayerDesk::open(arguments.now_playing);
    if (!players) {
        return fail(players.error());
    }
    const auto system = audio::AudioSystem::open(audio::audio_system_of(settings.audio_system));
    if (!system) {
        return fail(system.error());
    }
    const auto input = input_of(*system, settings);
    if (!input) {
        return fail(input.error());
    }
    auto models =
        load_ears(settings.ignore_tags ? engine::FileTags::ignored : engine::FileTags::read);
    if (!models) {
        return fail(models.error());
    }
    engine::LiveGraphConfig config = sound_config(settings);
    config.models = std::move(*models);
    config.is_device_named = !settings.device.empty();
    auto graph = engine::LiveGraph::listen(input->device, config);
    if (!graph) {
        return fail(graph.error());
    }
    say("listening to " + input->reason + "; nobody dances");
    if (const auto locked = lock_memory(); !locked) {
        say_detail(locked.error().message);
    }
    (*outputs)->follow((*graph)->feed(), config.models.dances);
    for (const std::string& line : (*remote)->opening_lines()) {
        say(line);
    }
    (*remote)->publish(engine::RemoteChoices{});
    serve_beats(**graph, **outputs, **remote, *players, config.models, arguments.duration);
    for (const std::string& line : (*outputs)->losses()) {
        say(line);
    }
    const BeatGrid grid = (*graph)->newest_music().grid;
    say(fmt::format("tempo {:.1f} BPM, confidence {:.2f}, level {}",
                    grid.tempo.bpm(),
                    grid.confidence,
                    level_meter((*graph)->analysis().level_dbfs(HostClock::now()))));
    return (*graph)->has_lost_device() ? kExitFailed : kExitDone;
}

}  // namespace raks::apps
