#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/random.hpp"

/// Curves over beats and frames: easing, splines, smooth noise and filters for authored motion.
namespace raks::motion {

/// One degree in radians: files and curves are in degrees.
inline constexpr double kDegree = M_PI / 180.0;
/// One centimetre in metres: likewise.
inline constexpr double kCentimetre = 0.01;

/// From 0 at s = 0 to 1 at s = 1 (clamped), with zero speed and acceleration at both ends.
[[nodiscard]] double ease(double s) noexcept;

/// Soft minimum of value and limit; `width` is the width of the transition.
[[nodiscard]] double soft_least(double value, double limit, double width) noexcept;

/// Natural cubic spline: twice continuously differentiable through all knots, straight beyond them.
/// Threads: any. Real-time: calls yes.
class Spline {
 public:
    /// `at`: rising positions of the knots; as many values; at least one.
    Spline(std::vector<double> at, std::vector<double> values);
    /// The value at x.
    [[nodiscard]] double operator()(double x) const noexcept;

 private:
    std::vector<double> at_;
    std::vector<double> values_;
    std::vector<double> slopes_;
};

/// Smooth noise over [from, to]: a spline through one standard normal number every `period`. The
/// numbers belong to absolute positions, so the range does not change them.
[[nodiscard]] Spline wander(const CounterRandom& random, double period, double from, double to);

/// Gaussian filter over equidistant values; sigma in samples (below 0.05: unchanged); the ends are
/// repeated.
[[nodiscard]] std::vector<double> blurred(std::span<const double> values, double sigma);

/// The value at a fractional index, interpolated linearly; the ends are repeated.
[[nodiscard]] double value_at(std::span<const double> values, double index) noexcept;

}  // namespace raks::motion
