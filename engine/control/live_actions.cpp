#include "engine/control/live_actions.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace raks::engine {

bool GraphTarget::command(audio::AnalyzerCommand::Kind kind, double value, HostTime came) {
    return graph_.command(kind, value, came);
}

bool GraphTarget::has_dancers() const { return graph_.has_dancers(); }

bool GraphTarget::command(motion::DancerCommand::Kind kind, double value) {
    return graph_.command(kind, value);
}

// The grid of the newest published stage, at most one wake-up of the motion thread old.
Bpm GraphTarget::tempo() {
    return (graph_.has_dancers() ? graph_.stage().music : graph_.newest_music()).grid.tempo;
}

Nanos GraphTarget::latency_offset() { return graph_.latency_offset(); }

void GraphTarget::set_latency_offset(Nanos offset) { graph_.set_latency_offset(offset); }

// playback() is null where a microphone is the input: there is nothing to pause or seek.
bool GraphTarget::plays_file() const { return graph_.playback() != nullptr; }

void GraphTarget::toggle_pause() {
    if (Playback* const playback = graph_.playback()) {
        playback->set_paused(!playback->is_paused());
    }
}

void GraphTarget::seek_by(double seconds) {
    if (Playback* const playback = graph_.playback()) {
        // Playback clamps the place to the start of the file, and ends behind its end.
        playback->seek(playback->position_seconds() + seconds);
    }
}

void GraphTarget::set_volume(float volume) {
    if (Playback* const playback = graph_.playback()) {
        playback->set_volume(volume);
    }
}

namespace {

using AnalyzerKind = audio::AnalyzerCommand::Kind;
using DancerKind = motion::DancerCommand::Kind;

// The range of latency_offset_ms in the settings, to either side.
constexpr Nanos kMostLatency = std::chrono::milliseconds(500);

// Actions that need a file that plays.
constexpr bool is_of_file(Action action) {
    return action == Action::pause || action == Action::seek || action == Action::volume;
}

// Actions that need dancers.
constexpr bool is_of_dancers(Action action) {
    return action == Action::next_figure || action == Action::select_figure ||
           action == Action::keep_figure;
}

}  // namespace

// An action and the member function that carries it out: one row for each, so that bind() is a
// loop.
struct LiveActions::Entry {
    Action action;
    void (LiveActions::*handle)(double);
};

std::span<const LiveActions::Entry> LiveActions::entries() noexcept {
    static constexpr std::array kEntries = {
        Entry{Action::pause, &LiveActions::pause},
        Entry{Action::seek, &LiveActions::seek},
        Entry{Action::volume, &LiveActions::change_volume},
        Entry{Action::latency, &LiveActions::change_latency},
        Entry{Action::tap_tempo, &LiveActions::tap_tempo},
        Entry{Action::half_tempo, &LiveActions::half_tempo},
        Entry{Action::double_tempo, &LiveActions::double_tempo},
        Entry{Action::three_two, &LiveActions::three_two},
        Entry{Action::change_tempo, &LiveActions::change_tempo},
        Entry{Action::set_tempo, &LiveActions::set_tempo},
        Entry{Action::hold_tempo, &LiveActions::hold_tempo},
        Entry{Action::release_tempo, &LiveActions::release_tempo},
        Entry{Action::nudge_beats, &LiveActions::nudge_beats},
        Entry{Action::resync_bar, &LiveActions::resync_bar},
        Entry{Action::next_figure, &LiveActions::next_figure},
        Entry{Action::select_figure, &LiveActions::select_figure},
        Entry{Action::keep_figure, &LiveActions::keep_figure},
    };
    return kEntries;
}

// A new target starts with no tempo asked for and no nudge; volume and latency offset are the
// person's and stay. A latency offset that no action has changed is left to the target, which has
// it from the settings.
void LiveActions::attach(LiveTarget& target) {
    target_ = &target;
    wished_tempo_.reset();
    nudged_milliseconds_ = 0.0;
    target.set_volume(volume_);
    if (latency_offset_) {
        target.set_latency_offset(*latency_offset_);
    }
}

void LiveActions::bind(ActionDispatcher& actions) {
    for (const Entry& entry : entries()) {
        if ((target_->plays_file() || !is_of_file(entry.action)) &&
            (target_->has_dancers() || !is_of_dancers(entry.action))) {
            actions.on_dated(entry.action,
                             [this, handle = entry.handle](double value, HostTime came) {
                                 came_ = came;
                                 (this->*handle)(value);
                             });
        }
    }
}

// New dancers begin with an unlocked figure.
void LiveActions::brief_dancers() {
    if (keeps_figure_) {
        command(DancerKind::lock_figure, 1.0);
    }
}

// The commands cross to a real-time thread through a bounded queue; a full queue loses this
// command, and the person is told so.
bool LiveActions::said_unless(bool is_queued) {
    if (!is_queued) {
        say_("too many commands at once: this one is left out");
    }
    return is_queued;
}

bool LiveActions::command(AnalyzerKind kind, double value) {
    return said_unless(target_->command(kind, value, came_));
}

bool LiveActions::command(DancerKind kind, double value) {
    return said_unless(target_->command(kind, value));
}

void LiveActions::ask(DancerKind kind, double value) {
    if (target_ != nullptr) {
        command(kind, value);
    }
}

void LiveActions::pause(double) { target_->toggle_pause(); }

void LiveActions::seek(double seconds) { target_->seek_by(seconds); }

void LiveActions::change_volume(double by) {
    // Only the settings may ask for more than the file's own loudness (1): an action goes up to 1,
    // or keeps a volume that is above it.
    const float loudest = std::max(volume_, 1.0F);
    volume_ = std::clamp(volume_ + static_cast<float>(by), 0.0F, loudest);
    target_->set_volume(volume_);
}

void LiveActions::change_latency(double milliseconds) {
    // The offset is a step on what the target has, which may come from the settings.
    const Nanos wished = target_->latency_offset() + nanos_from_seconds(milliseconds * 1e-3);
    latency_offset_ = std::clamp(wished, -kMostLatency, kMostLatency);
    target_->set_latency_offset(*latency_offset_);
    // Rounded to microseconds: nanosecond arithmetic would print 4.999999 ms.
    say_(fmt::format("latency offset {:+g} ms",
                     std::round(to_seconds(*latency_offset_) * 1e6) * 1e-3));
}

void LiveActions::tap_tempo(double) {
    // A tapped tempo replaces the one asked for by steps. The same holds for other ways to
    // change it.
    wished_tempo_.reset();
    command(AnalyzerKind::tap);
}

void LiveActions::half_tempo(double) {
    wished_tempo_.reset();
    command(AnalyzerKind::half_tempo);
}

void LiveActions::double_tempo(double) {
    wished_tempo_.reset();
    command(AnalyzerKind::double_tempo);
}

void LiveActions::three_two(double) {
    wished_tempo_.reset();
    command(AnalyzerKind::three_two);
}

void LiveActions::change_tempo(double bpm) {
    // The tracker takes the command one block later: of two quick steps the second must start from
    // the tempo asked for by the first, not from the tempo that the tracker still reports.
    const Bpm now = wished_tempo_.value_or(target_->tempo());
    hold_at(Bpm(now.bpm() + bpm));
}

void LiveActions::set_tempo(double bpm) { hold_at(Bpm(bpm)); }

void LiveActions::hold_at(Bpm tempo) {
    const Bpm wished = std::clamp(tempo, audio::kSlowestTempo, audio::kFastestTempo);
    // Only a queued command counts as asked for; else the next step would start from a tempo that
    // never came.
    if (command(AnalyzerKind::set_tempo, wished.bpm())) {
        wished_tempo_ = wished;
        say_(fmt::format("tempo held at {:.1f} BPM (R follows the music)", wished.bpm()));
    }
}

void LiveActions::hold_tempo(double) {
    if (command(AnalyzerKind::hold_tempo)) {
        say_("tempo held (R follows the music)");
    }
}

void LiveActions::release_tempo(double) {
    // Once the tracker follows the music, the next step must start from the tempo that it finds.
    wished_tempo_.reset();
    if (command(AnalyzerKind::release_tempo)) {
        say_("tempo follows the music");
    }
}

void LiveActions::nudge_beats(double milliseconds) {
    // The command is in seconds.
    if (command(AnalyzerKind::nudge, milliseconds * 1e-3)) {
        nudged_milliseconds_ += milliseconds;
        say_(fmt::format("beats {:g} ms {} ({:+g} ms in all)",
                         std::abs(milliseconds),
                         milliseconds < 0.0 ? "earlier" : "later",
                         nudged_milliseconds_));
    }
}

void LiveActions::resync_bar(double) {
    if (command(AnalyzerKind::resync_bar)) {
        say_("this beat is count 1");
    }
}

void LiveActions::next_figure(double) { command(DancerKind::next_figure); }

// People count figures from 1, the dancer from 0.
void LiveActions::select_figure(double number) { command(DancerKind::select_figure, number - 1.0); }

void LiveActions::keep_figure(double) {
    keeps_figure_ = !keeps_figure_;
    // 1 locks the present figure, 0 unlocks it.
    command(DancerKind::lock_figure, keeps_figure_ ? 1.0 : 0.0);
    say_(keeps_figure_ ? "keeping to this figure (K lets go)" : "figures as they come");
}

std::string chosen_dance_line(std::string_view dance, bool is_danced_already) {
    if (dance.empty()) {
        return "dancing what is heard (D: another dance)";
    }
    return fmt::format(
        "dancing {}{} (D: another dance)", dance, is_danced_already ? " already: it stays" : "");
}

}  // namespace raks::engine
