#pragma once

#include "base/beat_grid.hpp"
#include "base/beats.hpp"
#include "base/time.hpp"

namespace raks::motion {

/// What a dance is written in.
struct DanceMetre {
    Bpm learnt_tempo{120.0};
    int beats_per_bar = 4;
};

/// The dance's own continuous clock: a phase in beats of the figure that follows the music's beats
/// at the octave that suits the figure's learnt tempo.
///
/// It never runs backward: the phase's rate is the music's, corrected by at most +-20 %; an error
/// that stays above one beat for a second is not danced off but re-anchored, on the last beat of a
/// figure: no step lands there. Another octave begins where both have their count 1 on a downbeat.
/// Threads: one. Real-time: yes.
class DancePhase {
 public:
    /// Starts the figure: its count 1 falls on `downbeat`.
    void start(const BeatGrid& grid,
               Beats downbeat,
               const DanceMetre& metre,
               StreamTime now) noexcept;

    /// One hop on; `figure_end`: the phase at which the figure ends. True when it was re-anchored
    /// (the caller smooths the jump).
    bool advance(const BeatGrid& grid,
                 const DanceMetre& metre,
                 Beats figure_end,
                 StreamTime now) noexcept;

    /// Beats of the figure since count 1, >= 0, at the last advance.
    [[nodiscard]] Beats phase() const noexcept { return phase_; }
    /// The phase expected `ahead` from then.
    [[nodiscard]] Beats phase_after(Nanos ahead) const noexcept {
        return phase_ + Beats(rate_ * to_seconds(ahead));
    }
    /// Dance beats a beat of the music: 0.5, 1 or 2.
    [[nodiscard]] double octave() const noexcept { return octave_; }
    /// Dance beats a second.
    [[nodiscard]] double rate() const noexcept { return rate_; }

 private:
    void change_octave(double octave,
                       const BeatGrid& grid,
                       const DanceMetre& metre,
                       StreamTime now) noexcept;
    [[nodiscard]] Beats wanted(const BeatGrid& grid, StreamTime now) const noexcept;

    Beats origin_{};  // beat of the music on which count 1 fell
    Beats phase_{};
    double octave_ = 1.0;
    double rate_ = 2.0;
    int hops_apart_ = 0;
};

/// The octave whose rate, tempo x octave / learnt, lies in [0.70, 1.40], or nearest to that; `now`
/// is kept while its rate lies in [0.62, 1.6] (0: none yet). A
/// dance in threes knows no octave but 1: half or twice as fast its count 1 would leave the bar's.
[[nodiscard]] double choose_octave(Bpm music, const DanceMetre& metre, double now) noexcept;

}  // namespace raks::motion
