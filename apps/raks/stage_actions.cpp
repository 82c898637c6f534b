// What the stage does when keys, or others, ask for it.
#include <algorithm>
#include <string>

#include "apps/raks/stage_loop.hpp"
#include "apps/terminal/say.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using engine::Action;

// Up to this many seconds after a file's start, "back" means the file before; later, the start.
constexpr double kStillTheStart = 3.0;

}  // namespace

// Actions of this class, beside those of LiveActions and of the window.
void StageLoop::bind(engine::ActionDispatcher& actions) {
    live_actions_.bind(actions);
    bind_playing(actions);
    bind_choices(actions);
    actions.on(Action::keep_dance, [this](double) { keep_dance(); });
    actions.on(Action::next_formation, [this](double) {
        say(fmt::format("formation {} (E: another one)", formations_->ask_for_next()));
    });
    actions.on_text(Action::next_formation,
                    [this](const std::string& name) { return formations_->ask_for(name); });
    if (window_) {
        actions.on(Action::toggle_figure_view, [this](double) { toggle_figure_view(); });
        bind_calm(actions);
        actions.on(Action::record, [this](double) { toggle_recording(); });
    }
}

// Camera and light, which a window alone has.
void StageLoop::bind_calm(engine::ActionDispatcher& actions) {
    const auto set = [this](bool is_calm) {
        is_calm_ = is_calm;
        staging_.set_liveliness(is_calm ? render::Liveliness::calm : render::Liveliness::usual);
        say(is_calm ? "calm: less motion in the picture" : "as lively as usual");
    };
    actions.on(Action::calm, [this, set](double) { set(!is_calm_); });
    actions.on_text(Action::calm, [set](const std::string& word) {
        set(word == "on");
        return Expected<void>();
    });
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

// Files may have been added to the queue since this one began.
bool StageLoop::is_last_file() const {
    return source_.behind == StageSource::Behind::stay &&
           (source_.queue == nullptr || !source_.queue->has_more());
}

void StageLoop::go_on() {
    if (window_ && is_last_file()) {
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

// The dance that was chosen by D or by the settings, for whenever this song is played.
void StageLoop::keep_dance() {
    if (!source_.keep_dance) {
        say("no dance is kept: what is heard is no file that could be found again");
        return;
    }
    say(source_.keep_dance(choice_.name()));
}

}  // namespace raks::apps
