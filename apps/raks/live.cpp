#include "apps/raks/commands.hpp"

#include <cstdio>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/kept_window.hpp"
#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "audio/io/devices.hpp"

#include <fmt/format.h>

namespace raks::apps {

ExitCode live(const LiveArguments& given) {
    LiveArguments arguments = given;
    // The input first: without one there is nothing to dance to.
    auto system = audio::AudioSystem::open(audio::audio_system_of(arguments.settings.audio_system));
    if (!system) {
        return fail(system.error());
    }
    const KeptWindow kept =
        arguments.is_headless ? KeptWindow() : KeptWindow::recall(arguments.settings);
    const auto choice = input_of(*system, arguments.settings);
    if (!choice) {
        return fail(choice.error());
    }
    auto setup = open_formations(arguments.settings);
    if (!setup) {
        return fail(setup.error());
    }
    engine::Formations& formations = setup->formations;
    // The window before the audio: what comes in while it opens would be late.
    auto loop = StageLoop::create(arguments.settings,
                                  {arguments.is_headless,
                                   arguments.window,
                                   arguments.duration,
                                   arguments.outputs,
                                   arguments.video,
                                   kept},
                                  setup->catalogue.list(),
                                  formations);
    if (!loop) {
        return fail(loop.error());
    }
    engine::LiveGraphConfig config = sound_config(arguments.settings);
    config.models = setup->models;
    config.cast = formations.cast();
    config.is_device_named = !arguments.settings.device.empty();
    auto graph = engine::LiveGraph::listen(choice->device, config);
    if (!graph) {
        return fail(graph.error());
    }
    say("listening to " + choice->reason);
    // Why it ended does not matter: there is only one source.
    static_cast<void>((*loop)->run(**graph, {}));
    if (const auto why = (*loop)->why_lost(); !why.empty()) {
        return fail(std::string(why));
    }
    // Dances that could not be loaded meanwhile.
    for (const std::string& line : formations.wait()) {
        (*loop)->say(line);
    }
    // A last line with what the tracker had found, also for headless runs.
    const BeatGrid grid = (*graph)->stage().music.grid;
    say(fmt::format("tempo {:.1f} BPM, confidence {:.2f}, level {}",
                    grid.tempo.bpm(),
                    grid.confidence,
                    level_meter((*graph)->analysis().level_dbfs(HostClock::now()))));
    return (*graph)->has_lost_device() ? kExitFailed : kExitDone;
}

}  // namespace raks::apps
