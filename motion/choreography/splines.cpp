#include "motion/choreography/splines.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace raks::motion {
namespace {

/// Slopes at the knots of a natural cubic spline: a tridiagonal system, solved by the Thomas
/// algorithm (one sweep forward, one back).
std::vector<double> natural_slopes(const std::vector<double>& x, const std::vector<double>& y) {
    const std::size_t n = x.size();
    std::vector<double> slopes(n, 0.0);
    if (n < 2) {
        return slopes;
    }
    std::vector<double> upper(n, 0.0);
    std::vector<double> right(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const double before = i > 0 ? 1.0 / (x[i] - x[i - 1]) : 0.0;
        const double after = i + 1 < n ? 1.0 / (x[i + 1] - x[i]) : 0.0;
        const double rise_before = i > 0 ? (y[i] - y[i - 1]) * before : 0.0;
        const double rise_after = i + 1 < n ? (y[i + 1] - y[i]) * after : 0.0;
        // Continuity of the second derivative; at the ends, where one neighbour is missing, it is
        // zero.
        const double diagonal = 2.0 * (before + after);
        const double wanted = 3.0 * (rise_before * before + rise_after * after);
        const double pivot = diagonal - before * (i > 0 ? upper[i - 1] : 0.0);
        upper[i] = after / pivot;
        right[i] = (wanted - before * (i > 0 ? right[i - 1] : 0.0)) / pivot;
    }
    slopes[n - 1] = right[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) {
        slopes[i] = right[i] - upper[i] * slopes[i + 1];
    }
    return slopes;
}

}  // namespace

double ease(double s) noexcept {
    s = std::clamp(s, 0.0, 1.0);
    return s * s * s * (10.0 + s * (-15.0 + s * 6.0));
}

double soft_least(double value, double limit, double width) noexcept {
    const double over = (value - limit) / width;
    constexpr double kFar = 30.0;  // beyond it exp() gains nothing and may overflow
    return over > kFar ? limit : value - width * std::log1p(std::exp(over));
}

Spline::Spline(std::vector<double> at, std::vector<double> values)
    : at_(std::move(at)), values_(std::move(values)), slopes_(natural_slopes(at_, values_)) {
    RAKS_ASSERT(!at_.empty() && at_.size() == values_.size());
}

double Spline::operator()(double x) const noexcept {
    // Beyond the knots: straight on, with the slope of the end.
    if (x <= at_.front()) {
        return values_.front() + slopes_.front() * (x - at_.front());
    }
    if (x >= at_.back()) {
        return values_.back() + slopes_.back() * (x - at_.back());
    }
    const auto next =
        static_cast<std::size_t>(std::upper_bound(at_.begin(), at_.end(), x) - at_.begin());
    const std::size_t i = next - 1;
    const double width = at_[next] - at_[i];
    // Cubic Hermite form between two knots.
    const double t = (x - at_[i]) / width;
    const double s = 1.0 - t;
    return s * s * ((1.0 + 2.0 * t) * values_[i] + t * width * slopes_[i]) +
           t * t * ((1.0 + 2.0 * s) * values_[next] - s * width * slopes_[next]);
}

Spline wander(const CounterRandom& random, double period, double from, double to) {
    const auto first = static_cast<std::int64_t>(std::floor(from / period)) - 2;
    const auto last = static_cast<std::int64_t>(std::ceil(to / period)) + 2;
    std::vector<double> at;
    std::vector<double> values;
    for (std::int64_t k = first; k <= last; ++k) {
        at.push_back(static_cast<double>(k) * period);
        // Counted from far below zero, so that the numbers do not depend on where it begins.
        constexpr std::int64_t kOrigin = 1 << 20;
        values.push_back(random.normal(static_cast<std::uint64_t>(k + kOrigin)));
    }
    return {std::move(at), std::move(values)};
}

std::vector<double> blurred(std::span<const double> values, double sigma) {
    constexpr double kNone = 0.05;  // samples; a narrower filter changes nothing
    std::vector<double> result(values.begin(), values.end());
    if (sigma < kNone || values.empty()) {
        return result;
    }
    // Truncated at four deviations, normalised by the sum of the weights.
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(4.0 * sigma));
    std::vector<double> taps;
    double sum = 0.0;
    for (std::ptrdiff_t d = -reach; d <= reach; ++d) {
        const double x = static_cast<double>(d) / sigma;
        taps.push_back(std::exp(-0.5 * x * x));
        sum += taps.back();
    }
    const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        double total = 0.0;
        for (std::ptrdiff_t d = -reach; d <= reach; ++d) {
            const auto at = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + d, 0, last));
            total += taps[static_cast<std::size_t>(d + reach)] * values[at];
        }
        result[static_cast<std::size_t>(i)] = total / sum;
    }
    return result;
}

double value_at(std::span<const double> values, double index) noexcept {
    const double last = static_cast<double>(values.size() - 1);
    const double clamped = std::clamp(index, 0.0, last);
    const auto i = static_cast<std::size_t>(clamped);
    const std::size_t next = std::min(i + 1, values.size() - 1);
    const double share = clamped - static_cast<double>(i);
    return values[i] + share * (values[next] - values[i]);
}

}  // namespace raks::motion
