#include "apps/raks/commands.hpp"
#include "apps/raks/show_session.hpp"

namespace raks::apps {

ExitCode play(const PlayArguments& arguments) { return ShowSession(arguments).play(); }

ExitCode open(const PlayArguments& arguments) { return ShowSession(arguments).open(); }

ExitCode live(const LiveArguments& arguments) {
    if (arguments.has_no_avatar) {
        return serve_beats(arguments);
    }
    PlayArguments shared;
    shared.settings = arguments.settings;
    shared.is_headless = arguments.is_headless;
    shared.window = arguments.window;
    shared.outputs = arguments.outputs;
    shared.video = arguments.video;
    shared.remote = arguments.remote;
    shared.now_playing = arguments.now_playing;
    shared.motion = arguments.motion;
    return ShowSession(shared, arguments.duration).live();
}

}  // namespace raks::apps
