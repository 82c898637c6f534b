#include "motion/dance/beat_phase.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kMostCorrection = 0.2;  // of the rate
constexpr double kGain = 2.5;            // of the error in beats, a second
constexpr double kAstray = 1.0;      // beats of error that are re-anchored rather than danced off
constexpr int kAstrayHops = 100;     // hops (1 s) that the error must last
constexpr double kBarsOff = 2.0;     // for which count 1 must lie beside the downbeat
constexpr double kPause = 1.0;       // beats before a figure's end in which the phase may jump
constexpr double kMostSlew = 0.025;  // change of the rate a hop, as a share of it
// Middle of the chosen paces, 0.70 to 1.40 (geometric mean). Of two octaves whose pace is equally
// far from 1, the slower looks calm, the faster hurried.
constexpr double kMiddle = 0.99;
constexpr double kKeepLow = 0.62;  // an octave is kept in these wider limits (hysteresis)
constexpr double kKeepHigh = 1.6;
// A change waits for a suitable moment while the pace is at most this factor beyond those limits;
// in a ramp of 5 % a second that gives it two bars.
constexpr double kMostWaiting = 1.15;
// Beats between the count 1 of both octaves that count as agreeing
constexpr double kNearMoment = 0.03;

bool is_between(double value, double low, double high) { return value >= low && value <= high; }

/// Beats by which the phase deviates from the music while its rate is slewed linearly from one to
/// another.
double gained_in_slew(double from_rate, double to_rate) {
    const double change = from_rate - to_rate;
    return change * std::abs(change) / (2.0 * kMostSlew * to_rate) * to_seconds(kHop);
}

}  // namespace

double choose_octave(Bpm music, const DanceMetre& metre, double now) noexcept RAKS_NONBLOCKING {
    if (metre.beats_per_bar % 2 != 0) {
        return 1.0;
    }
    const double ratio = music.bpm() / metre.learnt_tempo.bpm();
    if (now > 0.0 && is_between(ratio * now, kKeepLow, kKeepHigh)) {
        return now;
    }
    double best = 1.0;
    for (const double octave : {0.5, 2.0}) {
        if (std::abs(std::log(ratio * octave / kMiddle)) <
            std::abs(std::log(ratio * best / kMiddle))) {
            best = octave;
        }
    }
    return best;
}

// The phase without any error: the music's beats since count 1, at this octave.
Beats DancePhase::wanted(const BeatGrid& grid, StreamTime now) const noexcept {
    return octave_ * (grid.beats_at(now) - origin_);
}

void DancePhase::start(const BeatGrid& grid,
                       Beats downbeat,
                       const DanceMetre& metre,
                       StreamTime now) noexcept RAKS_NONBLOCKING {
    octave_ = choose_octave(grid.tempo, metre, 0.0);
    origin_ = downbeat;
    phase_ = std::max(Beats(0.0), wanted(grid, now));
    rate_ = octave_ * grid.tempo.beats_per_second();
    hops_apart_ = 0;
    hops_off_bar_ = 0;
    has_lost_bar_ = false;
}

// A tracker that is not sure of its bar goes to and fro: a count that followed it would never be
// danced to its end.
void DancePhase::compare_with_bar(const BeatGrid& grid, const DanceMetre& metre) noexcept {
    const int bar = grid.beats_per_bar;
    const auto from_origin = std::lround((grid.bar_origin - origin_).count());
    const int off =
        bar == metre.beats_per_bar ? static_cast<int>((from_origin % bar + bar) % bar) : 0;
    hops_off_bar_ = off != 0 && off == beats_off_bar_ ? hops_off_bar_ + 1 : 0;
    beats_off_bar_ = off;
    has_lost_bar_ =
        hops_off_bar_ * to_seconds(kHop) > kBarsOff * bar * grid.tempo.seconds_per_beat();
}

void DancePhase::take_bar() noexcept {
    const Beats back = Beats(beats_off_bar());
    origin_ = origin_ + back;
    phase_ = std::max(Beats(0.0), phase_ - octave_ * back);
    hops_off_bar_ = 0;
    has_lost_bar_ = false;
}

void DancePhase::change_octave(double octave,
                               const BeatGrid& grid,
                               const DanceMetre& metre,
                               StreamTime now) noexcept {
    // Keeps about the phase, but puts count 1 on a downbeat again. Where both agree, as happens
    // once in two bars, no step leaves its beat. At a tempo far off there is no time to wait: the
    // error is danced off, or re-anchored when it is more than a beat.
    const Beats kept = grid.beats_at(now) - (1.0 / octave) * phase_;
    const double bars = (kept - grid.bar_origin).count() / grid.beats_per_bar;
    const double missing = octave * grid.beats_per_bar * (bars - std::round(bars));
    const double gained = gained_in_slew(rate_, octave * grid.tempo.beats_per_second());
    const double pace = octave_ * grid.tempo.bpm() / metre.learnt_tempo.bpm();
    const bool can_wait = is_between(pace, kKeepLow / kMostWaiting, kKeepHigh * kMostWaiting);
    if (can_wait && std::abs(missing - gained) > kNearMoment) {
        return;
    }
    octave_ = octave;
    origin_ = grid.bar_origin + Beats(grid.beats_per_bar * std::round(bars));
}

bool DancePhase::advance(const BeatGrid& grid,
                         const DanceMetre& metre,
                         Beats figure_end,
                         StreamTime now) noexcept RAKS_NONBLOCKING {
    const double octave = choose_octave(grid.tempo, metre, octave_);
    if (octave != octave_) {
        change_octave(octave, grid, metre, now);
    }
    const double music_rate = octave_ * grid.tempo.beats_per_second();
    const double hop = to_seconds(kHop);
    const double error = (wanted(grid, now) - phase_).count() - music_rate * hop;
    const double most = kMostCorrection * music_rate;
    // A change of octave slews the rate, since a jump of it would jerk every limb. No correction
    // meanwhile: change_octave() allowed for what the slew gains.
    const bool is_slewed = std::abs(rate_ - music_rate) > 1.25 * most;
    const double correction = is_slewed ? 0.0 : std::clamp(kGain * error, -most, most);
    const double slew = kMostSlew * music_rate;
    rate_ += std::clamp(music_rate + correction - rate_, -slew, slew);
    hops_apart_ = std::abs(error) > kAstray ? hops_apart_ + 1 : 0;
    compare_with_bar(grid, metre);
    if (hops_apart_ > kAstrayHops && (figure_end - phase_).count() <= kPause) {
        hops_apart_ = 0;
        phase_ = std::max(Beats(0.0), wanted(grid, now));
        rate_ = music_rate;
        return true;
    }
    phase_ = phase_ + Beats(rate_ * hop);
    return false;
}

}  // namespace raks::motion
