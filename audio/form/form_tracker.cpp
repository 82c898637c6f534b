#include "audio/form/form_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

// Beat and bar in hops. Without a beat that is sure, half a second and two; bars shorter than 1.6 s
// count as two, so that a bar holds enough of the rhythm.
BeatLengths lengths_of(const BeatGrid& grid) noexcept {
    BeatLengths lengths;
    if (grid.confidence < BeatGrid::kDanceable) {
        return lengths;
    }
    const double beat = std::clamp(grid.tempo.seconds_per_beat() * kHopsPerSecond, 25.0, 100.0);
    double bar = beat * grid.beats_per_bar;
    while (bar < 160.0) {
        bar *= 2.0;
    }
    lengths.beat = static_cast<int>(beat);
    lengths.phrase = static_cast<int>(4.0 * beat * grid.beats_per_bar);
    lengths.bar = static_cast<int>(std::min(bar, 400.0));
    return lengths;
}

}  // namespace

void FormTracker::queue(const MusicEvent& event) noexcept {
    if (event.kind != MusicEvent::Kind::none && event_count_ < kWaiting) {
        events_[event_count_++] = event;
    }
}

void FormTracker::set_part(MusicState& state) const noexcept {
    state.part = pauses_.is_stopped() ? MusicPart::stopped : sections_.part();
    state.energy = energy_;
}

void FormTracker::advance(std::span<const float, HopListener::kMelBands> mel,
                          MusicState& state) noexcept RAKS_NONBLOCKING {
    sound_ = listener_.advance(state.level_dbfs, mel);
    state.spectrum = spectrum_meter_.advance(state.level_dbfs, mel);
    const BeatLengths lengths = lengths_of(state.grid);
    MusicEvent event = pauses_.advance(state.hop, sound_.level, lengths.beat);
    if (event.kind == MusicEvent::Kind::stop) {
        sections_.pause(state.hop, lengths);
    } else if (event.kind == MusicEvent::Kind::entry) {
        sections_.go_on(state.hop);
    } else if (event.kind == MusicEvent::Kind::end) {
        // Its last chord or beat is the end; what rings after it is not.
        event.time = std::min(event.time, accents_.last_onset());
    }
    queue(event);
    energy_ = energy_meter_.advance(sound_, pauses_.is_stopped());
    if (!pauses_.is_stopped()) {
        queue(sections_.advance(state.hop, sound_, lengths, pauses_.is_quiet()));
        state.accent = accents_.advance(state.hop, sound_, state.grid);
    }
    set_part(state);
    if (event_count_ > 0) {
        state.event = events_.front();
        std::shift_left(events_.begin(), events_.end(), 1);
        --event_count_;
    }
}

void FormTracker::advance_lost(MusicState& state) const noexcept RAKS_NONBLOCKING {
    set_part(state);
}

void FormTracker::reset() noexcept RAKS_NONBLOCKING {
    listener_.reset();
    pauses_.reset();
    energy_meter_.reset();
    spectrum_meter_.reset();
    sections_.reset();
    accents_.reset();
    sound_ = {};
    energy_ = {0.0F, 0.5F, 0.5F};
    event_count_ = 0;
}

}  // namespace raks::audio
