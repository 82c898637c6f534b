// Range check: numbers that must lie in a range.
#pragma once

#include <fmt/format.h>

#include <span>

#include "base/expected.hpp"

namespace raks::motion {

/// A value that must lie in [lowest, highest]; NaN never does.
struct RangeCheck {
    const char* name;  ///< for the error
    double value;      ///< to be checked
    double lowest;     ///< least allowed
    double highest;    ///< greatest allowed
};

/// Checks values in order. Errors: the first one outside its range, by name. Threads: any.
/// Real-time: no.
[[nodiscard]] inline Expected<void> check(std::span<const RangeCheck> ranges) {
    for (const RangeCheck& range : ranges) {
        if (!(range.value >= range.lowest && range.value <= range.highest)) {
            return fail(fmt::format("{} is {}, must lie in [{}, {}]",
                                    range.name,
                                    range.value,
                                    range.lowest,
                                    range.highest));
        }
    }
    return {};
}

}  // namespace raks::motion
