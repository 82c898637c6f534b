#include "apps/raks/commands.hpp"

#include <cstdio>

#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/say.hpp"
#include "apps/terminal/signals.hpp"
#include "audio/io/devices.hpp"
#include "engine/setup/formations.hpp"

#include <fmt/format.h>

namespace raks::apps {

ExitCode live(const LiveArguments& arguments) {
    auto system = audio::AudioSystem::open();
    if (!system) {
        return fail(system.error());
    }
    const auto choice = audio::choose_input(system->devices(), arguments.settings.device);
    if (!choice) {
        return fail(choice.error());
    }
    auto formations = engine::Formations::load(arguments.settings);
    if (!formations) {
        return fail(formations.error());
    }
    auto loop =
        StageLoop::create(arguments.settings,
                          {arguments.is_headless, arguments.is_fullscreen, arguments.duration},
                          *formations);
    if (!loop) {
        return fail(loop.error());
    }
    engine::LiveGraphConfig config;
    config.members = formations->members();
    config.pose_lead = nanos_from_seconds(arguments.settings.pose_lead_ms * 1e-3);
    auto graph = engine::LiveGraph::listen(choice->device, config);
    if (!graph) {
        return fail(graph.error());
    }
    say("listening to " + choice->reason);
    static_cast<void>((*loop)->run(**graph, {.name = choice->device.name}));
    const auto all = formations->wait();
    if (!all) {
        (*loop)->say(all.error().message);
    }
    const BeatGrid grid = (*graph)->stage().music.grid;
    say(fmt::format("tempo {:.1f} BPM, confidence {:.2f}, level {}",
                    grid.tempo.bpm(),
                    grid.confidence,
                    level_meter((*graph)->analysis().level_dbfs())));
    return !all || (*graph)->has_lost_device() ? kExitFailed : kExitDone;
}

}  // namespace raks::apps
