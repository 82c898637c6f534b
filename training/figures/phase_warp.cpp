#include "training/figures/phase_warp.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/assert.hpp"

namespace raks::motion {

PhaseWarp::PhaseWarp(std::span<const double> beat_frames)
    : frames_(beat_frames.begin(), beat_frames.end()), slopes_(beat_frames.size()) {
    RAKS_ASSERT(frames_.size() >= 2);
    const std::size_t last = frames_.size() - 1;
    // The ends take the slope of their only neighbouring interval.
    for (std::size_t i = 0; i <= last; ++i) {
        const double before = i > 0 ? frames_[i] - frames_[i - 1] : frames_[1] - frames_[0];
        const double after = i < last ? frames_[i + 1] - frames_[i] : before;
        // The harmonic mean of both sides keeps the curve rising.
        slopes_[i] = 2.0 * before * after / (before + after);
    }
}

double PhaseWarp::frame_at(double beat) const noexcept {
    const double last = static_cast<double>(frames_.size() - 1);
    if (beat <= 0.0) {
        return frames_.front() + beat * slopes_.front();
    }
    if (beat >= last) {
        return frames_.back() + (beat - last) * slopes_.back();
    }
    const std::size_t i = static_cast<std::size_t>(beat);
    const double t = beat - static_cast<double>(i);
    const double step = frames_[i + 1] - frames_[i];
    // Cubic Hermite polynomial: the chord and a correction by how far the slope at each end (a, b)
    // departs from the chord's.
    const double a = slopes_[i] - step;
    const double b = step - slopes_[i + 1];
    return frames_[i] + t * step + t * (1.0 - t) * ((1.0 - t) * a + t * b);
}

double PhaseWarp::beat_at(double frame) const noexcept {
    if (frame <= frames_.front()) {
        return (frame - frames_.front()) / slopes_.front();
    }
    const double last = static_cast<double>(frames_.size() - 1);
    if (frame >= frames_.back()) {
        return last + (frame - frames_.back()) / slopes_.back();
    }
    // Rising, so bisection finds the only solution.
    double low = 0.0;
    double high = last;
    while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        (frame_at(middle) < frame ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace raks::motion
