// Beat phase: the dance's own clock, which follows the music's beats.
#pragma once

#include "base/beat_grid.hpp"
#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::motion {

/// Tempo and metre in which a dance was learnt.
struct DanceMetre {
    Bpm learnt_tempo{120.0};  ///< at which its figures look as learnt
    int beats_per_bar = 4;    ///< of the dance
};

/// The dance's own continuous clock: a phase in beats of the figure that follows the music's beats
/// at the octave (half, same or double tempo) that suits the learnt tempo.
///
/// It never runs backward while it follows: its rate is the music's, corrected by at most +-20 %.
/// An error that stays above one beat for a second is not danced off but re-anchored, during the
/// last beat of a figure, where no step lands. A change of octave begins where the count 1 of both
/// falls on a downbeat. Threads: one. Real-time: yes.
class DancePhase {
 public:
    /// Starts the figure: its count 1 falls on `downbeat`.
    void start(const BeatGrid& grid,
               Beats downbeat,
               const DanceMetre& metre,
               StreamTime now) noexcept RAKS_NONBLOCKING;

    /// One hop on; `figure_end`: the phase at which the figure ends. True when the phase was
    /// re-anchored (the caller smooths the jump).
    bool advance(const BeatGrid& grid,
                 const DanceMetre& metre,
                 Beats figure_end,
                 StreamTime now) noexcept RAKS_NONBLOCKING;

    /// Beats of the figure since count 1, >= 0, at the last advance.
    [[nodiscard]] Beats phase() const noexcept { return phase_; }
    /// The phase expected `ahead` from then.
    [[nodiscard]] Beats phase_after(Nanos ahead) const noexcept {
        return phase_ + Beats(rate_ * to_seconds(ahead));
    }
    /// Beats of the music by which the phase must go back for count 1 to fall on a downbeat: not 0
    /// when for two bars that has been so by the same number, because the bar was found late or
    /// anew. 0 also where the dance's bar has other beats than the music's.
    [[nodiscard]] int beats_off_bar() const noexcept { return has_lost_bar_ ? beats_off_bar_ : 0; }
    /// Goes back by beats_off_bar().
    void take_bar() noexcept;
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
    void compare_with_bar(const BeatGrid& grid, const DanceMetre& metre) noexcept;

    Beats origin_{};  // beat of the music on which count 1 fell
    Beats phase_{};
    double octave_ = 1.0;
    double rate_ = 2.0;
    int hops_apart_ = 0;
    int beats_off_bar_ = 0;  // from count 1 to the next downbeat
    int hops_off_bar_ = 0;   // for which that was the same, and not 0
    bool has_lost_bar_ = false;
};

/// The octave whose pace, tempo x octave / learnt tempo, lies in [0.70, 1.40], or nearest to that.
/// The octave `now` is kept while its pace lies in [0.62, 1.6] (0: none yet), so that it does not
/// flip to and fro. Odd metres know no octave but 1: at half or double speed count 1 would leave
/// the downbeat. Threads: any. Real-time: yes.
[[nodiscard]] double choose_octave(Bpm music,
                                   const DanceMetre& metre,
                                   double now) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
