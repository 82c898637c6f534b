#pragma once

#include <fmt/format.h>

#include <span>

#include "base/expected.hpp"

namespace raks::motion {

/// A value that must lie in [lowest, highest]; NaN never does.
struct RangeCheck {
    const char* name;
    double value;
    double lowest;
    double highest;
};

/// Errors: the first that does not lie in its range, by name.
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
