#include "audio/beat/beat_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "audio/beat/beat_limits.hpp"

namespace raks::audio {
namespace {

// Gains of the filter that follows the estimated phase: critically damped, time constant about 0.17
// s. With a phase gain of 0.07, one beat in 77 moved by 5 ms between two sample rates.
constexpr double kPhaseGain = 0.06;
constexpr double kTempoGain = kPhaseGain * kPhaseGain / 4.0;
constexpr double kTempoPull = 0.01;  // a hop, toward the estimated tempo
// The grid is set to the estimate at once after these differed by more than this for so long.
constexpr double kApartPhase = 0.12;  // beats
constexpr double kApartTempo = 0.10;  // ratio
constexpr int kApartHops = 6;
// Where a song began counts for the bars of its first 10 s.
constexpr HopIndex kStartCounts = 1'000;
// After this many beats without evidence of a beat the grid runs on by itself: the pointer's
// estimate slows down and spreads.
constexpr double kLongestWithout = 1.1;  // beats
constexpr double kSteadyBeats = 12.0;    // over which the tempo to run on with is averaged
constexpr double kFirstSteady = 1.0;     // beats, after a grid was set anew
constexpr double kSteadyReach = 0.05;    // ratio: beyond it the tempo was changing

// Evidence of beats off the believed pulse: how much of it is left out at most, and how far the
// pulse reaches, in hops.
constexpr float kOffBelieved = 0.8F;
constexpr double kBelievedReach = 4.0;

constexpr float kMassShare = 0.02F;                   // of a hop in the smoothed mass
constexpr float kKeepMargins = 1.0F - 1.0F / 500.0F;  // a hop: rivals are weighed over 5 s
constexpr float kSilentDecay = 0.985F;                // a hop: confidence is gone after 2 s

constexpr Nanos kAnnounceLead = kHop;

}  // namespace

void BeatTracker::reset() noexcept RAKS_NONBLOCKING {
    pointer_.reset();
    bars_.reset();
    changes_.reset();
    forget_bars();
    forget_pulses();
    pulse_beat_ = 0;
    sounding_beat_ = 0;
    change_ = 0.0F;
    taps_.reset();
    position_ = 0.0;
    beats_per_hop_ = 1.0 / 50;
    nudge_hops_ = 0.0;
    is_tempo_held_ = is_tempo_chosen_ = are_beats_set_ = false;
    hint_ = DanceId::none;
    begin_tempo();
    hops_without_ = 0;
    hops_apart_ = hops_with_evidence_ = 0;
    recent_ = {};
    rated_beat_ = 0;
    beats_rated_ = 0;
    contrast_ = mass_ = confidence_ = 0.0F;
    margins_.reset();
    verdict_ = {};
    hop_ = start_until_ = 0;
    quiet_hop_ = -1'000;
    start_.reset();
    owes_start_ = false;
    next_beat_ = next_predicted_ = 0;
    last_beat_time_ = last_predicted_time_ = StreamTime(std::chrono::seconds(-10));
    commands_.clear();
}

void BeatTracker::set_network(const BeatNetwork* network) {
    bar_stream_.reset();
    pulse_stream_.reset();
    confidence_model_ = network != nullptr ? network->confidence() : ConfidenceModel();
    if (network != nullptr && network->bars()) {
        bar_stream_.emplace(network->bars());
    }
    if (network != nullptr && network->pulses()) {
        pulse_stream_.emplace(network->pulses());
    }
}

// Bar evidence so far belongs to other music, or to beats that were numbered otherwise.
void BeatTracker::forget_bars() noexcept {
    bar_input_.reset();
    bar_evidence_.reset();
    if (bar_stream_) {
        bar_stream_->reset();
    }
}

// What was said of the pulse belongs to another one, or to other music.
void BeatTracker::forget_pulses() noexcept {
    pulses_.reset();
    pulse_input_.reset();
    if (pulse_stream_) {
        pulse_stream_->reset();
    }
}

void BeatTracker::jump() noexcept RAKS_NONBLOCKING {
    pointer_.open_positions();
    forget_bars();
    forget_pulses();
    hops_with_evidence_ = 0;
    beats_rated_ = 0;
    contrast_ = mass_ = confidence_ = 0.0F;
    margins_.reset();
    verdict_ = {};
}

// Entry of a hop in the ring of recent hops; a negative hop number is valid, too.
BeatTracker::HopEvidence& BeatTracker::evidence_at(HopIndex hop) noexcept {
    constexpr auto kCount = static_cast<HopIndex>(kRecent);
    return recent_[static_cast<std::size_t>((hop % kCount + kCount) % kCount)];
}

// Commands apply before the hop is evaluated. In silence the pointer moves on without evidence.
void BeatTracker::advance(const TrackedHop& hop, MusicState& state) noexcept RAKS_NONBLOCKING {
    position_ += beats_per_hop_;
    listen_for_start(hop);
    run_commands(time_of_hop(hop.hop));
    evidence_at(hop.hop) = {.strength = hop.onset_strength, .evidence = {}};
    if (hop.is_silent) {
        pointer_.advance_blind();
        confidence_ *= kSilentDecay;
    } else {
        track_tempo(hop);
        track_bars(hop);
        track_pulses(hop);
        rate_beat(hop);
        rate_confidence(hop);
    }
    publish(hop.hop, state);
    announce(hop, state);
}

void BeatTracker::advance_blind(HopIndex hop, MusicState& state) noexcept RAKS_NONBLOCKING {
    position_ += beats_per_hop_;
    evidence_at(hop) = {};
    run_commands(time_of_hop(hop));
    publish(hop, state);
}

// Updates the pointer with the hop's evidence and lets the grid follow, or run on alone.
void BeatTracker::track_tempo(const TrackedHop& hop) noexcept {
    // Soft for longer than a beat lasts: no hop of it holds evidence.
    if (hop.quiet_hops * beats_per_hop_ > kLongestWithout) {
        pointer_.advance_blind();
        run_alone();
        return;
    }
    if (hop.has_evidence) {
        // The evidence is of an earlier hop: the pointer takes that hop's onset strength with it.
        HopEvidence& then = evidence_at(hop.hop - hop.evidence_lag);
        then.evidence = hop.evidence;
        then.own_beat = hop.own_evidence.beat;
        pointer_.advance(then.strength, as_believed(hop.evidence, hop.evidence_lag));
        hops_without_ = hop.own_evidence.beat > kLeastEvidence ? 0 : hops_without_ + 1;
    } else {
        pointer_.advance(hop.onset_strength);
        hops_without_ = 0;
    }
    ++hops_with_evidence_;
    // In the first hops a missing beat is no reason to run on: nothing is known yet.
    if (hops_with_evidence_ >= kFirstHops && hops_without_ * beats_per_hop_ > kLongestWithout) {
        run_alone();
        return;
    }
    const double before = position_ - beats_per_hop_;
    follow(pointer_.estimate(), hop.evidence_lag);
    weigh_rivals(hop);
    keep_tempo(position_ - before);
}

// Starts the average tempo at the present one.
void BeatTracker::begin_tempo() noexcept {
    steady_rate_ = followed_rate_ = beats_per_hop_;
    steady_beats_ = kFirstSteady;
    drift_ = 0.0;
}

// Updates the average tempo, the one to run on with; `moved`: beats that the grid moved in this
// hop, corrections included.
void BeatTracker::keep_tempo(double moved) noexcept {
    if (std::abs(moved / beats_per_hop_ - 1.0) > 0.5) {  // the grid was set anew
        begin_tempo();
        return;
    }
    steady_beats_ = std::min(kSteadyBeats, steady_beats_ + beats_per_hop_);
    steady_rate_ += beats_per_hop_ / steady_beats_ * (moved - steady_rate_);
    // Without evidence of beats the grid strays after the pointer's estimate: run_alone() takes
    // that distance back.
    drift_ += moved - followed_rate_;
    if (hops_without_ == 0) {
        followed_rate_ = steady_rate_;
        drift_ = 0.0;
    }
}

// Runs on at the average tempo of the last evident beats, and takes back what the grid moved since
// then: the pointer's estimate had drifted before the lack of beats was noticed. Not where the
// tempo was changing or is held.
void BeatTracker::run_alone() noexcept {
    const bool is_steady = std::abs(followed_rate_ / beats_per_hop_ - 1.0) < kSteadyReach;
    if (is_steady && !is_tempo_held_) {
        beats_per_hop_ = followed_rate_;
        position_ -= std::exchange(drift_, 0.0);
    }
}

// Moves the grid toward the pointer's estimate.
void BeatTracker::follow(const PointerEstimate& estimate, int lag_hops) noexcept {
    const double believed_rate = 1.0 / estimate.period_hops;
    // The estimate is of `lag_hops` ago; the user's nudge and the onset's lag are added.
    const double lag = (lag_hops + kOnsetLagHops - nudge_hops_) * believed_rate;
    const double error = std::remainder(estimate.phase + lag - position_, 1.0);
    const bool is_tempo_apart =
        !is_tempo_held_ && std::abs(beats_per_hop_ / believed_rate - 1.0) > kApartTempo;
    if (are_beats_set_) {
        return;
    }
    const bool is_apart = is_tempo_apart || std::abs(error) > kApartPhase;
    hops_apart_ = is_apart ? hops_apart_ + 1 : 0;
    if (hops_with_evidence_ < kFirstHops || hops_apart_ > kApartHops) {
        hops_apart_ = 0;
        position_ += error;
        mass_ *= 0.5F;  // it belongs to another hypothesis
        if (is_apart) {
            margins_.reset();
            forget_pulses();
            owes_start_ = start_ && hop_ - *start_ < kStartCounts;
        }
        if (!is_tempo_held_) {
            beats_per_hop_ = believed_rate;
        }
        return;
    }
    if (is_tempo_apart) {
        return;  // another octave must last before the grid takes it
    }
    // Phase and tempo corrections of the second-order filter.
    position_ += kPhaseGain * error;
    if (!is_tempo_held_) {
        beats_per_hop_ += kTempoGain * error + kTempoPull * (believed_rate - beats_per_hop_);
    }
    mass_ += kMassShare * (estimate.mass - mass_);
}

// The evidence is of an earlier hop, at which the grid was where it came from.
void BeatTracker::weigh_rivals(const TrackedHop& hop) noexcept {
    if (!hop.has_evidence) {
        return;
    }
    const double lag = hop.evidence_lag + kOnsetLagHops - nudge_hops_;
    margins_.add(
        fit_pulses(
            position_ - lag * beats_per_hop_, 1.0 / beats_per_hop_, likelihood_of(hop.evidence)),
        kKeepMargins);
}

// Collects the sound of each beat for the bar evidence; a beat's evidence is complete when the next
// one begins.
void BeatTracker::track_bars(const TrackedHop& hop) noexcept {
    if (hop.mel_magnitudes.size() != OnsetDetector::kMelBands) {
        return;
    }
    // A window shows a sound before its centre reaches it.
    const double position = position_ + BarInput::kAheadHops * beats_per_hop_;
    const double beat = std::floor(position);
    if (std::lround(beat) != sounding_beat_) {
        sounding_beat_ = std::lround(beat);
        change_ = changes_.next_beat();
        if (bar_stream_ && hop.has_evidence) {
            bar_evidence_ = bar_stream_->next(bar_input_.next_beat());
        }
    }
    changes_.add(hop.mel_magnitudes.first<OnsetDetector::kMelBands>());
    if (bar_stream_ && hop.has_evidence) {
        bar_input_.add_hop(hop.mel_magnitudes, position - beat, hop.own_evidence);
    }
}

// What lies off the pulse that is believed to be the beat counts less: changing over costs.
BeatEvidence BeatTracker::as_believed(const BeatEvidence& evidence, int lag) const noexcept {
    const double position = position_ - (lag + kOnsetLagHops - nudge_hops_) * beats_per_hop_;
    const double hops_away = std::remainder(position, 1.0) / beats_per_hop_ / kBelievedReach;
    const auto off = static_cast<float>(1.0 - std::exp(-0.5 * hops_away * hops_away));
    const float belief = std::max(0.0F, 2.0F * pulses_.right() - 1.0F);
    BeatEvidence believed = evidence;
    believed.beat *= 1.0F - kOffBelieved * belief * off;
    return believed;
}

// Collects the sound of each beat for the network for the metre. When it says for long enough that
// another pulse is the beat, that one is followed, unless the user chose the tempo.
void BeatTracker::track_pulses(const TrackedHop& hop) noexcept {
    if (!pulse_stream_ || !hop.has_evidence ||
        hop.mel_magnitudes.size() != OnsetDetector::kMelBands) {
        return;
    }
    const double position =
        position_ + PulseInput::kAheadHops * beats_per_hop_ + PulseInput::kEarlier;
    const double beat = std::floor(position);
    if (std::lround(beat) != pulse_beat_) {
        pulses_.observe(pulse_beat_, pulse_stream_->next(pulse_input_.next_beat()));
        pulse_beat_ = std::lround(beat);
        const auto better = pulses_.better(margins_);
        const double bpm = beats_per_hop_ * kHopsPerSecond * 60.0;
        const bool is_heard = hops_without_ * beats_per_hop_ < kLongestWithout;
        if (better && is_heard && !is_tempo_told_ && !is_tempo_held_ && !is_tempo_chosen_ &&
            is_followed(Bpm(bpm * better->rate))) {
            take_pulse(*better);
            return;
        }
    }
    pulse_input_.add_hop(hop.mel_magnitudes, position - beat);
}

// Once all hops around a beat are known: its strength for the confidence, and its bar evidence.
void BeatTracker::rate_beat(const TrackedHop& hop) noexcept {
    constexpr int kAround = 2;  // hops on either side of the beat
    // The hops after the beat and the evidence's delay have to pass first.
    const int wait = kAround + 1 + hop.evidence_lag;
    const long beat = std::lround(std::floor(position_ - wait * beats_per_hop_));
    if (beat == rated_beat_) {
        return;
    }
    rated_beat_ = beat;
    const double hops_ago = (position_ - static_cast<double>(beat)) / beats_per_hop_;
    const HopIndex centre = hop.hop - std::lround(hops_ago - kOnsetLagHops);
    float strength = 0.0F;
    BeatEvidence most;
    float own = 0.0F;
    for (HopIndex at = centre - kAround; at <= centre + kAround; ++at) {
        const HopEvidence& then = evidence_at(at);
        strength += then.strength / (2 * kAround + 1);
        most.beat = std::max(most.beat, then.evidence.beat);
        own = std::max(own, then.own_beat);
        most.downbeat = std::max(most.downbeat, then.evidence.downbeat);
    }
    // A plain mean over the first 8 beats, an exponential one later.
    beats_rated_ = std::min(beats_rated_ + 1, 8);
    // Whether there is a beat at all our own networks tell best: others hear one in any sound.
    const float contrast = hop.has_evidence ? own : strength;
    contrast_ += (contrast - contrast_) / static_cast<float>(beats_rated_);
    // Changes and bar evidence are of the beat before, so they come before next_beat().
    bars_.observe_change(std::exchange(change_, 0.0F));
    if (bar_evidence_) {
        bars_.observe_bar(*std::exchange(bar_evidence_, std::nullopt));
    }
    bars_.next_beat(beat);
    place_start();
    // A beat with little evidence says nothing about the bar.
    if (hop.has_evidence && most.beat > kLeastEvidence) {
        bars_.observe_downbeat(most.downbeat / most.beat);
    }
}

// Confidence: with networks how sure the beat is before its rivals; without, the probability of the
// pointer's hypothesis times the onsets on its beats.
void BeatTracker::rate_confidence(const TrackedHop& hop) noexcept {
    const float least = hop.has_evidence ? kLeastEvidence : kLeastStrength;
    const float full = hop.has_evidence ? kFullEvidence : kFullStrength;
    on_beats_ = std::clamp((contrast_ - least) / (full - least), 0.0F, 1.0F);
    if (!hop.has_evidence) {
        confidence_ = std::min(1.0F, 1.1F * mass_) * on_beats_;
        return;
    }
    verdict_ = judge_beat(confidence_model_,
                          margins_,
                          pulses_.right(),
                          beats_per_hop_ * kHopsPerSecond * 60.0,
                          on_beats_);
    confidence_ = verdict_.confidence;
}

// The grid as a line through the current hop.
void BeatTracker::publish(HopIndex hop, MusicState& state) const noexcept {
    state.grid.anchor_time = time_of_hop(hop);
    state.grid.anchor_beat = Beats(position_);
    state.grid.tempo = Bpm(beats_per_hop_ * kHopsPerSecond * 60.0);
    state.grid.beats_per_bar = bars_.beats_per_bar();
    state.grid.bar_origin = Beats(static_cast<double>(bars_.origin()));
    state.grid.confidence = confidence_;
    state.grid.bar_confidence = bars_.confidence();
    state.is_tempo_held = is_tempo_held_;
    const double rival_bpm = verdict_.rival_rate * state.grid.tempo.bpm();
    state.rival = {verdict_.rival > 0.0F ? rival_bpm : 0.0, verdict_.rival};
    state.beat_parts = margins_.for_three() > 0.0F ? 3 : 2;
}

// A beat is announced once, when it is due. One that follows the last too soon is left out: the
// grid was set anew in between.
void BeatTracker::announce(const TrackedHop& hop, MusicState& state) noexcept {
    const Nanos least_gap = nanos_from_seconds(kLeastGap * state.grid.tempo.seconds_per_beat());
    // After a jump of the grid, forward or back, the next beats to announce are near its position.
    const long at_least = std::lround(std::floor(position_ - 0.5)) + 1;
    next_beat_ = std::clamp(next_beat_, at_least, at_least + 2);
    next_predicted_ = std::clamp(next_predicted_, at_least, at_least + 3);
    const bool is_told = confidence_ > kAnnounceConfidence && !hop.is_silent;
    const StreamTime beat = state.grid.time_of(Beats(static_cast<double>(next_beat_)));
    if (beat <= hop.audio_end + kAnnounceLead) {
        if (is_told && beat - last_beat_time_ > least_gap) {
            last_beat_time_ = beat;
            const int in_bar = static_cast<int>(
                std::lround(state.grid.bar_position(Beats(static_cast<double>(next_beat_)))));
            state.has_beat = true;
            state.beat = {beat,
                          in_bar % state.grid.beats_per_bar + 1,
                          confidence_,
                          state.grid.bar_confidence};
        }
        ++next_beat_;
    }
    const StreamTime predicted = state.grid.time_of(Beats(static_cast<double>(next_predicted_)));
    if (predicted <= hop.audio_end + kPredictedLead) {
        if (is_told && predicted - last_predicted_time_ > least_gap) {
            last_predicted_time_ = predicted;
            state.has_predicted = true;
            state.predicted = predicted;
        }
        ++next_predicted_;
    }
}

}  // namespace raks::audio
