#include "audio/beat/beat_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace raks::audio {
namespace {

// An onset is strongest in the window whose middle lies this much behind it; measured on clicks.
constexpr double kOnsetLagHops = -0.05;

// The filter that follows the believed phase: critically damped, about 0.15 s.
constexpr double kPhaseGain = 0.07;
constexpr double kTempoGain = kPhaseGain * kPhaseGain / 4.0;
constexpr double kTempoPull = 0.01;  // a hop, toward the believed period
// Belief and grid may disagree this much before the grid is set anew; for as long as this.
constexpr double kApartPhase = 0.12;  // beats
constexpr double kApartTempo = 0.10;  // ratio
constexpr int kApartHops = 20;
constexpr int kFirstHops = 150;  // until then the grid is set anew at once

constexpr float kAnnounceConfidence = 0.05F;
constexpr float kLeastContrast = 0.15F;  // onset strength on the beat that noise has, too
constexpr float kFullContrast = 0.9F;
constexpr float kMassShare = 0.02F;
constexpr float kSilentDecay = 0.985F;  // a hop: confidence is gone after 2 s

constexpr float kUnsure = 0.15F;
constexpr int kUnsureHops = 300;

constexpr Nanos kPredictedLead = std::chrono::milliseconds(100);
constexpr Nanos kAnnounceLead = kHop;
constexpr double kLeastGap = 0.45;  // of a beat between two announcements

double wrapped(double phase) { return phase - std::round(phase); }

}  // namespace

void BeatTracker::reset() noexcept RAKS_NONBLOCKING {
    pointer_.reset();
    bars_.reset();
    taps_.reset();
    position_ = 0.0;
    beats_per_hop_ = 1.0 / 50;
    nudge_hops_ = 0.0;
    is_tempo_held_ = is_halved_ = is_octave_users_ = false;
    shift_ = 0.0;
    hops_apart_ = hops_heard_ = hops_unsure_ = 0;
    recent_ = {};
    rated_beat_ = 0;
    beats_rated_ = 0;
    contrast_ = mass_ = confidence_ = 0.0F;
    next_beat_ = next_predicted_ = 0;
    last_beat_time_ = last_predicted_time_ = StreamTime(std::chrono::seconds(-10));
    command_count_ = 0;
}

void BeatTracker::jump() noexcept RAKS_NONBLOCKING {
    pointer_.open_positions();
    if (is_halved_) {
        is_halved_ = false;
        pointer_.expect_any_tempo();
    }
    shift_ = 0.0;
    hops_heard_ = 0;
    beats_rated_ = 0;
    contrast_ = mass_ = confidence_ = 0.0F;
}

void BeatTracker::advance(const TrackedHop& hop, MusicState& state) noexcept RAKS_NONBLOCKING {
    position_ += beats_per_hop_;
    run_commands(time_of_hop(hop.hop));
    recent_[static_cast<std::size_t>(hop.hop) % kRecent] = hop.onset.strength;
    if (hop.is_silent) {
        pointer_.advance_blind();
        confidence_ *= kSilentDecay;
    } else {
        pointer_.advance(hop.onset.strength);
        ++hops_heard_;
        follow(pointer_.estimate());
        const double bpm = beats_per_hop_ * kHopsPerSecond * 60.0;
        heed(bars_.add(hop.onset, position_, bpm));
        rate_confidence(hop);
    }
    publish(hop.hop, state);
    announce(hop, state);
}

void BeatTracker::advance_blind(HopIndex hop, MusicState& state) noexcept RAKS_NONBLOCKING {
    position_ += beats_per_hop_;
    recent_[static_cast<std::size_t>(hop) % kRecent] = 0.0F;
    run_commands(time_of_hop(hop));
    publish(hop, state);
}

/// Moves the grid toward what the pointer believes.
void BeatTracker::follow(const PointerEstimate& estimate) noexcept {
    const double believed_rate = 1.0 / estimate.period_hops;
    const double lag = (kOnsetLagHops - nudge_hops_) * believed_rate;
    const double error = wrapped(estimate.phase + shift_ + lag - position_);
    const bool is_tempo_apart =
        !is_tempo_held_ && std::abs(beats_per_hop_ / believed_rate - 1.0) > kApartTempo;
    const bool is_apart = is_tempo_apart || std::abs(error) > kApartPhase;
    hops_apart_ = is_apart ? hops_apart_ + 1 : 0;
    if (hops_heard_ < kFirstHops || hops_apart_ > kApartHops) {
        hops_apart_ = 0;
        position_ += error;
        if (!is_tempo_held_) {
            beats_per_hop_ = believed_rate;
        }
        return;
    }
    if (is_tempo_apart) {
        return;  // wait: a guess at another octave must last before it is danced
    }
    position_ += kPhaseGain * error;
    if (!is_tempo_held_) {
        beats_per_hop_ += kTempoGain * error + kTempoPull * (believed_rate - beats_per_hop_);
    }
    mass_ += kMassShare * (estimate.mass - mass_);
}

/// What the folded onsets say of the grid: another octave, or half a beat off. A user's tempo wins.
void BeatTracker::heed(GridAdvice advice) noexcept {
    const double bpm = beats_per_hop_ * kHopsPerSecond * 60.0;
    hops_unsure_ = confidence_ < kUnsure ? hops_unsure_ + 1 : 0;
    if (is_halved_ && !is_octave_users_ && hops_unsure_ > kUnsureHops) {
        // Another song, maybe a faster one.
        is_halved_ = false;
        pointer_.expect_any_tempo();
    }
    if (shift_ != 0.0 && hops_unsure_ > kUnsureHops) {
        // Half a beat on there is nothing to dance to: it was a mistake.
        hops_unsure_ = 0;
        shift_ = 0.0;
        position_ += 0.5;
    }
    if (is_tempo_held_ || is_octave_users_) {
        return;
    }
    const double whole = std::floor(position_);
    switch (advice) {
        case GridAdvice::keep:
            break;
        case GridAdvice::shift_half:
            shift_ = 0.5 - shift_;
            position_ += 0.5;
            break;
        case GridAdvice::halve:
        case GridAdvice::halve_other: {
            // The beat number goes on; only its fraction changes: beats of the other parity are no
            // longer beats.
            const double first = advice == GridAdvice::halve ? 0.0 : 1.0;
            const double half = 0.5 * (position_ - first);
            const double fraction = half - std::floor(half);
            beats_per_hop_ *= 0.5;
            is_halved_ = true;
            fastest_bpm_ = 0.75 * bpm;
            pointer_.expect_below(fastest_bpm_);
            pointer_.believe(0.5 * bpm, fraction);
            shift_ = 0.0;
            position_ = whole + fraction;
            break;
        }
        case GridAdvice::double_up:
            if (is_halved_) {
                is_halved_ = false;
                pointer_.expect_any_tempo();
                const double fraction = 2.0 * (position_ - whole);
                beats_per_hop_ *= 2.0;
                pointer_.believe(2.0 * bpm, fraction - std::floor(fraction));
                shift_ = 0.0;
                position_ = whole + fraction - std::floor(fraction);
            }
            break;
    }
}

/// Confidence: the pointer is sure of one hypothesis, and there are onsets on its beats.
void BeatTracker::rate_confidence(const TrackedHop& hop) noexcept {
    constexpr int kAround = 2;  // hops on either side of the beat
    const double beats_ago = (kAround + 1) * beats_per_hop_;
    const long beat = std::lround(std::floor(position_ - beats_ago));
    if (beat != rated_beat_) {
        rated_beat_ = beat;
        const double hops_ago = (position_ - static_cast<double>(beat)) / beats_per_hop_;
        const HopIndex centre = hop.hop - std::lround(hops_ago - kOnsetLagHops);
        float strength = 0.0F;
        for (HopIndex at = centre - kAround; at <= centre + kAround; ++at) {
            strength +=
                recent_[static_cast<std::size_t>(at + static_cast<HopIndex>(kRecent)) % kRecent] /
                (2 * kAround + 1);
        }
        beats_rated_ = std::min(beats_rated_ + 1, 8);
        contrast_ += (strength - contrast_) / static_cast<float>(beats_rated_);
    }
    const float onsets =
        std::clamp((contrast_ - kLeastContrast) / (kFullContrast - kLeastContrast), 0.0F, 1.0F);
    confidence_ = std::min(1.0F, 1.1F * mass_) * onsets;
}

void BeatTracker::publish(HopIndex hop, MusicState& state) const noexcept {
    state.grid.anchor_time = time_of_hop(hop);
    state.grid.anchor_beat = Beats(position_);
    state.grid.tempo = Bpm(beats_per_hop_ * kHopsPerSecond * 60.0);
    state.grid.beats_per_bar = BarTracker::kBeatsPerBar;
    state.grid.bar_origin = Beats(bars_.origin());
    state.grid.confidence = confidence_;
}

/// A beat is told once, when it is due; one that comes too soon after the last is passed over (the
/// grid was set anew in between).
void BeatTracker::announce(const TrackedHop& hop, MusicState& state) noexcept {
    const Nanos least_gap = nanos_from_seconds(kLeastGap * state.grid.tempo.seconds_per_beat());
    const long at_least = std::lround(std::floor(position_ - 0.5)) + 1;
    next_beat_ = std::clamp(next_beat_, at_least, at_least + 2);
    next_predicted_ = std::clamp(next_predicted_, at_least, at_least + 3);
    const bool is_told = confidence_ > kAnnounceConfidence && !hop.is_silent;
    const StreamTime beat = state.grid.time_of(Beats(static_cast<double>(next_beat_)));
    if (beat <= hop.heard_until + kAnnounceLead) {
        if (is_told && beat - last_beat_time_ > least_gap) {
            last_beat_time_ = beat;
            const int in_bar = static_cast<int>(
                std::lround(state.grid.bar_position(Beats(static_cast<double>(next_beat_)))));
            state.has_beat = true;
            state.beat = {beat, in_bar % BarTracker::kBeatsPerBar + 1, confidence_};
        }
        ++next_beat_;
    }
    const StreamTime predicted = state.grid.time_of(Beats(static_cast<double>(next_predicted_)));
    if (predicted <= hop.heard_until + kPredictedLead) {
        if (is_told && predicted - last_predicted_time_ > least_gap) {
            last_predicted_time_ = predicted;
            state.has_predicted = true;
            state.predicted = predicted;
        }
        ++next_predicted_;
    }
}

bool BeatTracker::command(const AnalyzerCommand& command) noexcept RAKS_NONBLOCKING {
    if (command_count_ == kCommands) {
        return false;
    }
    commands_[command_count_++] = command;
    return true;
}

void BeatTracker::run_commands(StreamTime now) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < command_count_; ++i) {
        if (commands_[i].time <= now) {
            apply(commands_[i], now);
        } else {
            commands_[kept++] = commands_[i];
        }
    }
    command_count_ = kept;
}

/// The grid's phase becomes `phase` by the shortest way.
void BeatTracker::set_position(double phase) noexcept { position_ += wrapped(phase - position_); }

void BeatTracker::apply(const AnalyzerCommand& command, StreamTime now) noexcept {
    using Kind = AnalyzerCommand::Kind;
    const double bpm = beats_per_hop_ * kHopsPerSecond * 60.0;
    const double hops_ago = to_seconds(now - command.time) * kHopsPerSecond;
    const auto change_tempo = [&](double wanted) {
        const double in_range = std::clamp(wanted, 50.0, 230.0);
        beats_per_hop_ = in_range / (60.0 * kHopsPerSecond);
        pointer_.expect_tempo(in_range);
        if (std::abs(wrapped(position_)) < 0.25) {
            pointer_.expect_beat();
        }
    };
    switch (command.kind) {
        case Kind::tap:
            if (const auto tapped = taps_.tap(command.time)) {
                change_tempo(*tapped);
                set_position(hops_ago * beats_per_hop_);
                pointer_.expect_beat();
            }
            break;
        case Kind::half_tempo:
            change_tempo(0.5 * bpm);
            is_octave_users_ = true;
            break;
        case Kind::double_tempo:
            change_tempo(2.0 * bpm);
            is_octave_users_ = true;
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
        case Kind::release_tempo:
            // What the user held; an octave that the music told stays.
            is_tempo_held_ = is_octave_users_ = false;
            pointer_.expect_any_tempo();
            if (is_halved_) {
                pointer_.expect_below(fastest_bpm_);
            }
            break;
    }
}

}  // namespace raks::audio
