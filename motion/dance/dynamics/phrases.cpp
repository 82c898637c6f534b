#include "motion/dance/dynamics/phrases.hpp"

#include <cmath>

namespace raks::motion {

void Phrases::begin(const BeatGrid& grid, StreamTime time) noexcept RAKS_NONBLOCKING {
    const Beats beats = grid.beats_at(time);
    const double into = grid.bar_position(beats);
    const double bar = grid.beats_per_bar;
    origin_ = into < 0.5 * bar ? beats - Beats(into) : beats + Beats(bar - into);
    bar_ = 0.0;
}

// By beats, which are numbered on and on: a grid may name any bar line as its origin. The grid may
// move a little, so that only the rest of a phrase is taken from it.
void Phrases::advance(const MusicState& music) noexcept RAKS_NONBLOCKING {
    const MusicEvent::Kind kind = music.event.kind;
    if (kind == MusicEvent::Kind::entry || kind == MusicEvent::Kind::drop) {
        begin(music.grid, music.event.time);
    }
    const double bars =
        (music.grid.beats_at(music.time) - origin_).count() / music.grid.beats_per_bar;
    const double bar = bars - kBars * std::floor(bars / kBars);
    // Half a phrase back at once is the next phrase; small steps back are the grid's.
    if (bar_ - bar > 0.5 * kBars) {
        ++number_;
    }
    bar_ = bar;
}

}  // namespace raks::motion
