#pragma once

#include <limits>
#include <optional>
#include <string>

namespace raks::apps {

/// The range that a quantity must lie in, both ends included.
struct Bound {
    double lowest = -std::numeric_limits<double>::infinity();  ///< -infinity: no lower bound
    double highest = std::numeric_limits<double>::infinity();  ///< +infinity: no upper bound

    /// True inside the range; false for NaN.
    [[nodiscard]] bool holds(double value) const noexcept {
        return value >= lowest && value <= highest;
    }
};

/// A bound as text: "<= 25", ">= 0.95" or "-15..15"; empty where there is none.
[[nodiscard]] std::string bound_cell(const std::optional<Bound>& bound, int digits);

}  // namespace raks::apps
