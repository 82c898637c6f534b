#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/random.hpp"

/// Curves over beats and frames of which authored motion is made.
namespace raks::motion {

/// In radians: files and curves are in degrees.
inline constexpr double kDegree = M_PI / 180.0;

/// From 0 at s = 0 to 1 at s = 1 (clamped) without speed and acceleration at either end.
[[nodiscard]] double ease(double s) noexcept;

/// Twice continuously differentiable through all knots, straight beyond them (natural cubic).
class Spline {
 public:
    /// `at` rises; as many values; at least one.
    Spline(std::vector<double> at, std::vector<double> values);
    [[nodiscard]] double operator()(double x) const noexcept;

 private:
    std::vector<double> at_;
    std::vector<double> values_;
    std::vector<double> slopes_;
};

/// A smooth wander: a spline through standard normal numbers every `period`, over [from, to].
[[nodiscard]] Spline wander(const CounterRandom& random, double period, double from, double to);

/// Gaussian over values at equal distances, sigma in them (under 0.05: none); ends are held.
[[nodiscard]] std::vector<double> blurred(std::span<const double> values, double sigma);

/// The value at a fractional index, straight between two; ends are held.
[[nodiscard]] double value_at(std::span<const double> values, double index) noexcept;

}  // namespace raks::motion
