#pragma once

#include <span>
#include <vector>

namespace raks::motion {

/// Frame as a smooth, rising function of the beat through the given frames of beats 0, 1, 2, ...:
/// monotone cubic interpolation (Fritsch and Carlson 1980), so that a change of tempo between two
/// beats makes no kink in the speed of everything. Straight beyond the ends.
class PhaseWarp {
 public:
    /// At least 2 frames, rising.
    explicit PhaseWarp(std::span<const double> beat_frames);

    [[nodiscard]] double frame_at(double beat) const noexcept;
    /// Its inverse (by bisection, to 1e-9 beats); may lie beyond the ends.
    [[nodiscard]] double beat_at(double frame) const noexcept;

 private:
    std::vector<double> frames_;
    std::vector<double> slopes_;  // frames a beat, at each beat
};

}  // namespace raks::motion
