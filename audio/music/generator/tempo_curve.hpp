#pragma once

#include <vector>

namespace raks::audio {

/// The tempo at one time of a piece; between two points it changes linearly.
struct TempoPoint {
    double seconds = 0.0;  ///< since the start of the piece
    double bpm = 120.0;    ///< beats a minute, > 0
};

/// Tempo as a piecewise linear function of time, and its exact integral: the beat position at a
/// time and the time of a beat. Constant before the first and after the last point; two points at
/// the same second make a jump.
/// Threads: any (immutable). Real-time: queries yes, O(points).
class TempoCurve {
 public:
    /// `points`: at least one, seconds ascending (two may be equal), bpm > 0.
    /// `first_beat_seconds`: the time of beat 0.
    TempoCurve(const std::vector<TempoPoint>& points, double first_beat_seconds);

    /// Tempo at this time.
    [[nodiscard]] double bpm_at(double seconds) const noexcept;
    /// Beats since beat 0 (negative before it): integral of bpm/60 from the first beat.
    [[nodiscard]] double beats_at(double seconds) const noexcept;
    /// Inverse of beats_at: the time at which this many beats have passed.
    [[nodiscard]] double seconds_at(double beats) const noexcept;

 private:
    /// bpm = bpm + slope x (seconds - start), from `start` on; `beats` were counted before it.
    struct Piece {
        double start = 0.0;
        double bpm = 0.0;
        double slope = 0.0;
        double beats = 0.0;
    };
    [[nodiscard]] const Piece& piece_at(double seconds) const noexcept;
    [[nodiscard]] double integral_at(double seconds) const noexcept;

    std::vector<Piece> pieces_;
    double beats_before_first_ = 0.0;
};

}  // namespace raks::audio
