#pragma once

#include <span>
#include <vector>

namespace raks::motion {

/// Maps beats to frames and back: a smooth, rising curve through the given frames of beats 0, 1, 2,
/// ... by monotone cubic interpolation (Fritsch and Carlson 1980). A piecewise linear map would
/// give every joint's speed a step at each change of tempo. Linear beyond the ends.
/// Threads: any. Real-time: no.
class PhaseWarp {
 public:
    /// `beat_frames`: at least 2 frames, rising.
    explicit PhaseWarp(std::span<const double> beat_frames);

    /// Frame, with a fraction, of a beat; any real number.
    [[nodiscard]] double frame_at(double beat) const noexcept;
    /// The inverse of frame_at (by bisection, to 1e-9 beats); may lie beyond the ends.
    [[nodiscard]] double beat_at(double frame) const noexcept;

 private:
    std::vector<double> frames_;
    std::vector<double> slopes_;  // frames a beat, at each beat
};

}  // namespace raks::motion
