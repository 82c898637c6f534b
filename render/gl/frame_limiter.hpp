#pragma once

#include "base/time.hpp"

namespace raks::render {

/// When the next picture is due. Pure arithmetic over HostTime, so that a test can drive it.
///
/// Where vertical sync paces the loop, the limiter allows 10 % more pictures than the monitor
/// shows, so that the two do not wait for each other; it then acts only when the sync is ignored
/// (Xvfb, hidden windows). Threads: one.
class FrameLimiter {
 public:
    /// `exact`: the limiter alone sets the rate. `behind_vsync`: it only catches a sync that is
    /// ignored.
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
    /// Shortest time between two pictures.
    [[nodiscard]] Nanos period() const noexcept { return period_; }

 private:
    Nanos period_;
    HostTime due_{};
};

/// Sleeps until `due` on CLOCK_MONOTONIC; returns at once when it has passed.
void sleep_until(HostTime due) noexcept;

}  // namespace raks::render
