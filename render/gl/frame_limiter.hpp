#pragma once

#include "base/time.hpp"

namespace raks::render {

/// When the next picture is due. Pure arithmetic over HostTime, so that a test drives it.
///
/// Where vertical sync paces the loop the limiter must not fight it: it then allows 10 % more
/// pictures than the monitor shows and comes into play only when the sync is ignored (Xvfb,
/// hidden windows).
/// Threads: one.
class FrameLimiter {
 public:
    enum class Pace { exact, behind_vsync };

    /// `fps` > 0.
    FrameLimiter(double fps, Pace pace) noexcept
        : period_(nanos_from_seconds((pace == Pace::exact ? 1.0 : 0.9) / fps)) {}

    /// Called when a picture was handed over at `now`: returns until when to sleep. A late picture
    /// is not made up for: the next one is due a whole period after it.
    [[nodiscard]] HostTime next_due(HostTime now) noexcept {
        const HostTime due = due_ + period_;
        due_ = due < now ? now : due;
        return due_;
    }
    [[nodiscard]] Nanos period() const noexcept { return period_; }

 private:
    Nanos period_;
    HostTime due_{};
};

/// Sleeps until `due` on CLOCK_MONOTONIC; returns at once when it has passed.
void sleep_until(HostTime due) noexcept;

}  // namespace raks::render
