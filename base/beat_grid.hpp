#pragma once

#include <cmath>

#include "base/beats.hpp"
#include "base/time.hpp"

namespace raks {

/// The tracker's present estimate of the beats: a linear map between stream time and beats. It is
/// replaced every hop; what was already danced is never rewritten. Beat numbers continue over
/// replacements (the tracker counts on), so Beats(k) stays the same beat while nothing is
/// re-anchored.
///
///     const double phase = BeatPhase(grid.beats_at(now)).value();
///     const StreamTime next = grid.time_of(Beats(std::ceil(grid.beats_at(now).count())));
///
/// A trivially copyable value; every method is real-time safe from any thread.
struct BeatGrid {
    /// Confidence from which on music can be danced to.
    static constexpr float kDanceable = 0.35F;

    StreamTime anchor_time{};  ///< stream time of `anchor_beat`
    Beats anchor_beat{};       ///< any position, mostly a whole beat
    Bpm tempo{120.0};          ///< slope of the line, > 0
    int beats_per_bar = 4;     ///< 2 to 7
    Beats bar_origin{};        ///< a beat that is a downbeat ("1"); every beats_per_bar-th is
    float confidence = 0.0F;   ///< [0, 1]; 0: no estimate, the line only continues
    /// [0, 1]: how sure beats_per_bar and bar_origin are.
    float bar_confidence = 0.0F;

    /// Position on the beat axis at a time; any time.
    [[nodiscard]] Beats beats_at(StreamTime time) const noexcept {
        return anchor_beat + Beats(to_seconds(time - anchor_time) * tempo.beats_per_second());
    }

    /// Inverse of beats_at, to the nanosecond.
    [[nodiscard]] StreamTime time_of(Beats position) const noexcept {
        return anchor_time +
               nanos_from_seconds((position - anchor_beat).count() * tempo.seconds_per_beat());
    }

    /// Position in the bar, [0, beats_per_bar): 0 on the downbeat. A position within 1e-6 beats
    /// before a bar line counts as the bar line: rounding must not lose a downbeat.
    [[nodiscard]] double bar_position(Beats position) const noexcept {
        const double bar = beats_per_bar;
        const double from_origin = (position - bar_origin).count() + 1e-6;
        const double inside = from_origin - bar * std::floor(from_origin / bar) - 1e-6;
        return inside < 0.0 ? 0.0 : inside;
    }

    friend bool operator==(const BeatGrid&, const BeatGrid&) = default;
};

}  // namespace raks
