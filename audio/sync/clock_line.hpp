#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace raks::audio {

/// How one clock runs against another: a moment at `t` seconds of the one is at
/// offset + (1 + drift_ppm / 1e6) t seconds of the other.
struct ClockLine {
    double offset = 0.0;     ///< the other clock when this one is at 0; seconds
    double drift_ppm = 0.0;  ///< > 0: this clock is slow (its second is longer); parts in a million

    /// The other clock's time at `t` of this clock.
    [[nodiscard]] double at(double t) const noexcept {
        return offset + (1.0 + drift_ppm * 1e-6) * t;
    }
    /// The same line from the other clock to this one.
    [[nodiscard]] ClockLine inverse() const noexcept {
        const double rate = 1.0 + drift_ppm * 1e-6;
        return {-offset / rate, (1.0 / rate - 1.0) * 1e6};
    }
    /// This line, then `next`, which goes on from the other clock to a third.
    [[nodiscard]] ClockLine then(const ClockLine& next) const noexcept {
        const double rate = (1.0 + drift_ppm * 1e-6) * (1.0 + next.drift_ppm * 1e-6);
        return {next.at(offset), (rate - 1.0) * 1e6};
    }
};

/// The same moment by two clocks.
struct ClockPoint {
    double time = 0.0;        ///< by the one; seconds
    double other = 0.0;       ///< by the other; seconds
    double height = 0.0;      ///< of the peak that told it
    double deviations = 0.0;  ///< as CorrelationPeak
};

/// A straight line through most of the points.
struct ClockFit {
    ClockLine line;
    std::vector<bool> is_on_line;  ///< for each point
    std::size_t used = 0;          ///< how many are on it
    double spread = 0.0;           ///< root mean square of their distances, seconds
};

/// The line with the most points within `tolerance` seconds of it (all pairs of points are tried),
/// fitted to those by least squares. Any number of points off it does not bend it. Nothing where
/// there are fewer than two, or all are at one time. Threads: any. Real-time: no.
[[nodiscard]] std::optional<ClockFit> fit_clock_line(std::span<const ClockPoint> points,
                                                     double tolerance);

}  // namespace raks::audio
