#pragma once

#include <optional>

#include "base/time.hpp"

namespace raks::engine {

/// Notices that the computer slept: CLOCK_BOOTTIME counts that time, CLOCK_MONOTONIC does not.
/// Threads: one. Real-time: no.
class SleepWatch {
 public:
    /// Takes both clocks' present times; how long the computer slept since the last call, if for
    /// half a second or more.
    [[nodiscard]] std::optional<Nanos> look(Nanos boot_time, Nanos monotonic) noexcept {
        constexpr Nanos kLeast = std::chrono::milliseconds(500);
        const Nanos ahead = boot_time - monotonic;
        const Nanos slept = ahead_ ? ahead - *ahead_ : Nanos(0);
        ahead_ = ahead;
        return slept >= kLeast ? std::optional(slept) : std::nullopt;
    }
    /// look() at the clocks themselves.
    [[nodiscard]] std::optional<Nanos> look() noexcept;

 private:
    std::optional<Nanos> ahead_;
};

}  // namespace raks::engine
