#include "motion/dance/dynamics/phrases.hpp"

#include <cmath>

namespace raks::motion {
namespace {

double bars_at(const BeatGrid& grid, StreamTime time) noexcept {
    return (grid.beats_at(time) - grid.bar_origin).count() / grid.beats_per_bar;
}

}  // namespace

void Phrases::begin(const BeatGrid& grid, StreamTime time) noexcept RAKS_NONBLOCKING {
    origin_ = std::round(bars_at(grid, time));
    bar_ = 0.0;
}

// The grid may be renumbered or move a little, so that only the rest of a phrase is taken from it.
void Phrases::advance(const MusicState& music) noexcept RAKS_NONBLOCKING {
    const MusicEvent::Kind kind = music.event.kind;
    if (kind == MusicEvent::Kind::entry || kind == MusicEvent::Kind::drop) {
        begin(music.grid, music.event.time);
    }
    const double bars = bars_at(music.grid, music.time) - origin_;
    const double bar = bars - kBars * std::floor(bars / kBars);
    // Half a phrase back at once is the next phrase; small steps back are the grid's.
    if (bar_ - bar > 0.5 * kBars) {
        ++number_;
    }
    bar_ = bar;
}

}  // namespace raks::motion
