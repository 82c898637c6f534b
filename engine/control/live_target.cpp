#include "engine/control/live_target.hpp"

namespace raks::engine {

bool GraphTarget::command(audio::AnalyzerCommand::Kind kind, double value) {
    return graph_.command(kind, value);
}

bool GraphTarget::command(motion::DancerCommand::Kind kind, double value) {
    return graph_.command(kind, value);
}

// The grid of the newest published stage, at most one wake-up of the motion thread old.
Bpm GraphTarget::tempo() { return graph_.stage().music.grid.tempo; }

Nanos GraphTarget::latency_offset() { return graph_.latency_offset(); }

void GraphTarget::set_latency_offset(Nanos offset) { graph_.set_latency_offset(offset); }

void GraphTarget::toggle_pause() {
    // playback() is null where a microphone is the input: there is nothing to pause or seek.
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

}  // namespace raks::engine
