#include "audio/music/generator/tempo_curve.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace raks::audio {

// A linear tempo has a quadratic integral; each piece keeps the beats before it.
TempoCurve::TempoCurve(const std::vector<TempoPoint>& points, double first_beat_seconds) {
    RAKS_ASSERT(!points.empty());
    double beats = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const TempoPoint& point = points[i];
        double slope = 0.0;
        double length = 0.0;
        if (i + 1 < points.size()) {
            length = points[i + 1].seconds - point.seconds;
            slope = length > 0.0 ? (points[i + 1].bpm - point.bpm) / length : 0.0;
        }
        pieces_.push_back({point.seconds, point.bpm, slope, beats});
        beats += (point.bpm + 0.5 * slope * length) * length / 60.0;
    }
    beats_before_first_ = integral_at(first_beat_seconds);
}

// The last piece that begins at or before `seconds`; the first one for times before it.
const TempoCurve::Piece& TempoCurve::piece_at(double seconds) const noexcept {
    const auto next = std::upper_bound(
        pieces_.begin(), pieces_.end(), seconds, [](double value, const Piece& piece) {
            return value < piece.start;
        });
    return next == pieces_.begin() ? *next : *std::prev(next);
}

double TempoCurve::bpm_at(double seconds) const noexcept {
    const Piece& piece = piece_at(seconds);
    return piece.bpm + piece.slope * std::max(seconds - piece.start, 0.0);
}

// Before the first point the tempo is constant: no slope there.
double TempoCurve::integral_at(double seconds) const noexcept {
    const Piece& piece = piece_at(seconds);
    const double inside = seconds - piece.start;
    const double slope = inside > 0.0 ? piece.slope : 0.0;
    return piece.beats + (piece.bpm + 0.5 * slope * inside) * inside / 60.0;
}

double TempoCurve::beats_at(double seconds) const noexcept {
    return integral_at(seconds) - beats_before_first_;
}

// Solves the quadratic of the piece that contains the beat.
double TempoCurve::seconds_at(double beats) const noexcept {
    const double wanted = beats + beats_before_first_;
    const auto next = std::upper_bound(
        pieces_.begin(), pieces_.end(), wanted, [](double value, const Piece& piece) {
            return value < piece.beats;
        });
    const Piece& piece = next == pieces_.begin() ? *next : *std::prev(next);
    const double rest = (wanted - piece.beats) * 60.0;  // = bpm x + slope x^2 / 2
    const double slope = rest > 0.0 ? piece.slope : 0.0;
    // The root of the quadratic in the form that does not cancel, and is right for slope 0.
    const double root = std::sqrt(std::max(piece.bpm * piece.bpm + 2.0 * slope * rest, 0.0));
    return piece.start + 2.0 * rest / (piece.bpm + root);
}

}  // namespace raks::audio
