#include "motion/dance/beat_phase.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kMostCorrection = 0.2;  // of the rate
constexpr double kGain = 2.5;            // of the error, a second
constexpr double kApart = 1.0;           // beats
constexpr int kApartHops = 100;
constexpr double kPause = 1.0;       // beats before a figure's end
constexpr double kMostSlew = 0.025;  // of the rate, a hop
// A rate in the middle of those that are chosen: 0.70 to 1.40. Of two that are as far from 1, the
// slower looks calm, the faster hurried.
constexpr double kMiddle = 0.99;
constexpr double kKeepLow = 0.62;
constexpr double kKeepHigh = 1.6;

}  // namespace

double choose_octave(Bpm music, const DanceMetre& metre, double now) noexcept {
    if (metre.beats_per_bar % 2 != 0) {
        return 1.0;
    }
    const double ratio = music.bpm() / metre.learnt_tempo.bpm();
    if (now > 0.0 && ratio * now >= kKeepLow && ratio * now <= kKeepHigh) {
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

Beats DancePhase::wanted(const BeatGrid& grid, StreamTime now) const noexcept {
    return octave_ * (grid.beats_at(now) - origin_);
}

void DancePhase::start(const BeatGrid& grid,
                       Beats downbeat,
                       const DanceMetre& metre,
                       StreamTime now) noexcept {
    octave_ = choose_octave(grid.tempo, metre, 0.0);
    origin_ = downbeat;
    phase_ = std::max(Beats(0.0), wanted(grid, now));
    rate_ = octave_ * grid.tempo.beats_per_second();
    hops_apart_ = 0;
}

bool DancePhase::advance(const BeatGrid& grid,
                         const DanceMetre& metre,
                         Beats figure_end,
                         StreamTime now) noexcept {
    const double octave = choose_octave(grid.tempo, metre, octave_);
    if (octave != octave_) {
        // From about where it is, but with count 1 on a downbeat again: what is missing is danced
        // off, or re-anchored when it is more than a beat.
        octave_ = octave;
        const Beats kept = grid.beats_at(now) - (1.0 / octave_) * phase_;
        const double bars = (kept - grid.bar_origin).count() / grid.beats_per_bar;
        origin_ = grid.bar_origin + Beats(grid.beats_per_bar * std::round(bars));
    }
    const double music_rate = octave_ * grid.tempo.beats_per_second();
    const double hop = to_seconds(kHop);
    const double error = (wanted(grid, now) - phase_).count() - music_rate * hop;
    const double correction =
        std::clamp(kGain * error, -kMostCorrection * music_rate, kMostCorrection * music_rate);
    // Another octave does not change the pace at once: that would be a blow to every limb.
    const double slew = kMostSlew * music_rate;
    rate_ += std::clamp(music_rate + correction - rate_, -slew, slew);
    hops_apart_ = std::abs(error) > kApart ? hops_apart_ + 1 : 0;
    if (hops_apart_ > kApartHops && (figure_end - phase_).count() <= kPause) {
        hops_apart_ = 0;
        phase_ = std::max(Beats(0.0), wanted(grid, now));
        rate_ = music_rate;
        return true;
    }
    phase_ = phase_ + Beats(rate_ * hop);
    return false;
}

}  // namespace raks::motion
