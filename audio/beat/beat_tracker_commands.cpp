// What is asked of the beat tracker by a person and by what is known of songs, and what the network
// for the metre changes over to.
#include <algorithm>
#include <cmath>

#include "audio/beat/beat_limits.hpp"
#include "audio/beat/beat_tracker.hpp"

namespace raks::audio {

bool BeatTracker::command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING {
    return commands_.push(command);
}

void BeatTracker::run_commands(StreamTime now) noexcept {
    commands_.run_due(now, [&](const AnalyzerCommand& command) { apply(command, now); });
}

// Moves the grid to this phase by the shortest way.
void BeatTracker::set_position(double phase) noexcept {
    position_ += std::remainder(phase - position_, 1.0);
}

// The user's tempo: grid and pointer both take it. A grid near a beat keeps that beat.
void BeatTracker::change_tempo(double bpm) noexcept {
    const double in_range = std::clamp(bpm, kSlowestTempo.bpm(), kFastestTempo.bpm());
    beats_per_hop_ = in_range / (60.0 * kHopsPerSecond);
    begin_tempo();
    is_tempo_chosen_ = true;
    forget_pulses();
    pointer_.expect_tempo(in_range);
    if (std::abs(std::remainder(position_, 1.0)) < 0.25) {
        pointer_.expect_beat();
    }
}

// Allows any tempo.
void BeatTracker::release_tempo() noexcept {
    is_tempo_held_ = is_tempo_chosen_ = are_beats_set_ = false;
    expect_hinted();
}

// Tempi of the hinted dance are likelier.
void BeatTracker::expect_hinted() noexcept {
    const DanceInfo* const dance = dances_ ? dances_->find(hint_) : nullptr;
    if (dance != nullptr) {
        pointer_.expect_range(dance->lowest.bpm(), dance->highest.bpm());
    } else {
        pointer_.expect_any_tempo();
    }
}

// Half or double tempo: beat numbers continue, and each new downbeat is one of the old ones.
void BeatTracker::change_octave(double factor) noexcept {
    const double bpm = beats_per_hop_ * kHopsPerSecond * 60.0;
    // At half tempo a bar of the new count lasts two of the old one.
    const double bar = bars_.beats_per_bar() / std::min(1.0, factor);
    const double from_origin = position_ - static_cast<double>(bars_.origin());
    const double in_bar = factor * (from_origin - bar * std::floor(from_origin / bar));
    const double whole = std::floor(position_);
    position_ = whole + in_bar - std::floor(in_bar);
    bars_.recount(std::lround(whole - std::floor(in_bar)));
    change_tempo(factor * bpm);
    pointer_.believe(factor * bpm, in_bar - std::floor(in_bar));
    forget_bars();
}

// This pulse becomes the beat. Where its count 1 is has to be found anew.
void BeatTracker::take_pulse(const RivalPulse& rival) noexcept {
    const double position = rival.rate * position_ + rival.offset;
    const double phase = position - std::floor(position);
    position_ = std::floor(position_) + phase;
    beats_per_hop_ *= rival.rate;
    begin_tempo();
    pointer_.believe(beats_per_hop_ * kHopsPerSecond * 60.0, phase);
    hops_apart_ = 0;
    margins_.reset();
    bars_.reset();
    forget_bars();
    forget_pulses();
}

// The likeliest of the pulses with three beats for two or two for three becomes the beat.
void BeatTracker::take_three_two() noexcept {
    const double bpm = beats_per_hop_ * kHopsPerSecond * 60.0;
    const RivalPulse rival = margins_.likeliest([bpm](const RivalPulse& pulse) {
        return is_followed(Bpm(bpm * pulse.rate)) &&
               (pulse.kind == RivalKind::three_for_two || pulse.kind == RivalKind::two_for_three);
    });
    take_pulse(rival);
    change_tempo(beats_per_hop_ * kHopsPerSecond * 60.0);
}

void BeatTracker::apply(const AnalyzerCommand& command, StreamTime now) noexcept {
    using Kind = AnalyzerCommand::Kind;
    const double hops_ago = to_seconds(now - command.time) * kHopsPerSecond;
    switch (command.kind) {
        case Kind::tap:
            if (const auto tapped = taps_.tap(command.time)) {
                change_tempo(*tapped);
                set_position(hops_ago * beats_per_hop_);
                pointer_.expect_beat();
            }
            break;
        case Kind::half_tempo:
            change_octave(0.5);
            break;
        case Kind::double_tempo:
            change_octave(2.0);
            break;
        case Kind::three_two:
            take_three_two();
            break;
        case Kind::nudge: {
            const double hops = std::clamp(command.value, -0.5, 0.5) * kHopsPerSecond;
            nudge_hops_ += hops;
            position_ -= hops * beats_per_hop_;
            break;
        }
        case Kind::resync_bar:
            bars_.hold(std::lround(position_ - hops_ago * beats_per_hop_));
            break;
        case Kind::set_tempo:
            change_tempo(command.value);
            is_tempo_held_ = true;
            break;
        case Kind::hold_tempo:
            pointer_.expect_tempo(beats_per_hop_ * kHopsPerSecond * 60.0);
            pointer_.believe(beats_per_hop_ * kHopsPerSecond * 60.0,
                             position_ - std::floor(position_));
            is_tempo_held_ = true;
            break;
        case Kind::set_beat:
            set_position(hops_ago * beats_per_hop_);
            is_tempo_held_ = are_beats_set_ = true;
            break;
        case Kind::release_tempo:
            release_tempo();
            break;
        case Kind::hint_genre:
            hint_ = static_cast<DanceId>(
                std::clamp(static_cast<int>(command.value), 0, static_cast<int>(DanceId::none)));
            if (!is_tempo_held_) {
                release_tempo();
            }
            break;
    }
}

void BeatTracker::expect_told(double bpm) noexcept RAKS_NONBLOCKING {
    pointer_.expect_told(bpm);
    is_tempo_told_ = bpm > 0.0;
    // A tempo that a person has chosen rules out others already.
    if (!is_tempo_held_ && !is_tempo_chosen_) {
        expect_hinted();
    }
}

void BeatTracker::begin_song() noexcept RAKS_NONBLOCKING {
    jump();
    bars_.reset();
    changes_.reset();
    taps_.reset();
    change_ = 0.0F;
    if (is_tempo_held_) {
        return;
    }
    // Who plays it says so somewhat before or behind its first sound.
    constexpr HopIndex kBefore = 50;
    constexpr HopIndex kBehind = 150;
    // Players name a song when they read it, and what they have read before sounds a fifth of a
    // second more; without quiet between songs this is what is known.
    constexpr HopIndex kPlayersKeep = 20;
    start_ = hop_ - quiet_hop_ < kBefore ? quiet_hop_ + 1 : hop_ + kPlayersKeep;
    start_until_ = hop_ + kBehind;
    owes_start_ = true;
    is_tempo_chosen_ = false;
    hint_ = DanceId::none;
    pointer_.reset();
    begin_tempo();
    hops_apart_ = hops_without_ = 0;
}

// The first sound of a song is the last one behind quiet.
void BeatTracker::listen_for_start(const TrackedHop& hop) noexcept {
    hop_ = hop.hop;
    if (hop.quiet_hops > 0) {
        quiet_hop_ = hop_;
        if (owes_start_ && hop_ < start_until_) {
            start_ = hop_ + 1;
        }
    }
}

// Songs mostly begin on the first beat of a bar. Told once the grid is no longer set anew with each
// hop, and again where it was.
void BeatTracker::place_start() noexcept {
    constexpr double kNear = 0.25;  // beats
    if (!owes_start_ || hops_with_evidence_ < kFirstHops) {
        return;
    }
    owes_start_ = false;
    if (!start_) {
        return;
    }
    const double hops_ago = static_cast<double>(hop_ - *start_) + kOnsetLagHops;
    const double place = position_ - hops_ago * beats_per_hop_;
    if (std::abs(std::remainder(place, 1.0)) < kNear) {
        bars_.observe_start(std::lround(place));
    }
}

}  // namespace raks::audio
