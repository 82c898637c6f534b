#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/assert.hpp"

/// Order statistics of a few numbers. Threads: any. Real-time: no (they copy the numbers).
///
/// Where a place lies between two values they differ, and measures were taken by each:
/// percentile(), as numpy's, and median() draw the line between the two; nth_value(),
/// upper_median() and lower_percentile() give one of the values.
namespace raks {

/// The value that would stand at `index` were they sorted. `index`: below their number.
template <typename T>
[[nodiscard]] T nth_value(std::vector<T> values, std::size_t index) {
    RAKS_ASSERT(index < values.size());
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The middle value, of an even number the upper one of two. There must be one.
template <typename T>
[[nodiscard]] T upper_median(std::vector<T> values) {
    const std::size_t middle = values.size() / 2;
    return nth_value(std::move(values), middle);
}

/// The value that this `share` of them, 0 to 1, does not exceed; 0 where there are none.
[[nodiscard]] inline double lower_percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    const auto index = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
    return nth_value(std::move(values), index);
}

/// The same on the line between neighbours; 0 where there are none.
[[nodiscard]] inline double percentile(std::vector<double> values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - std::floor(at)) * (values[above] - values[below]);
}

/// The middle value, or the mean of the two middle ones; nothing where there are none.
[[nodiscard]] inline std::optional<double> median(std::span<const double> values) {
    if (values.empty()) {
        return std::nullopt;
    }
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

}  // namespace raks
