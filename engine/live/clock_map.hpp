#pragma once

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// A straight line between CLOCK_MONOTONIC and stream time, as estimated last. Trivially copyable:
/// it passes from thread to thread through LatestValue<ClockLine>.
struct ClockLine {
    StreamTime stream_anchor{};    ///< stream time at host_anchor
    HostTime host_anchor{};        ///< host time at stream_anchor
    double stream_per_host = 1.0;  ///< rate of the device's clock, about 1
    bool is_running = false;       ///< false: paused or not started; stream time stands still

    /// Stream time at a host time; the anchor while not running.
    [[nodiscard]] StreamTime stream_at(HostTime host) const noexcept;
    /// Inverse of stream_at; the host anchor while not running.
    [[nodiscard]] HostTime host_at(StreamTime stream) const noexcept;
};

/// The only place where stream time meets host time: a delay-locked loop over the pairs that the
/// audio callback takes (Adriaensen 2005, "Using a DLL to filter time"). Scheduling jitter of the
/// callback is averaged, the device's drift is followed, a jump (lost audio) starts anew.
///
/// Threads: one (the audio callback). Real-time: yes.
class ClockMap {
 public:
    /// The block whose first sample has stream time `stream` was handed over at `host`.
    void update(StreamTime stream, HostTime host) noexcept RAKS_NONBLOCKING;
    /// The device lost or repeated audio: the line may be off by that much (measured: up to 35 ms
    /// an xrun on JACK, which the narrow loop carried along for seconds). Widens the loop as after
    /// a start, so that a step of 30 ms is followed to within 2 ms after half a second.
    void loosen() noexcept RAKS_NONBLOCKING { seconds_since_restart_ = 0.0; }
    /// Stream time stands still at `stream` (pause, end); the next update() restarts the loop
    /// there.
    void stop(StreamTime stream) noexcept RAKS_NONBLOCKING;

    /// The line as of the last update() or stop().
    [[nodiscard]] const ClockLine& line() const noexcept { return line_; }

 private:
    void restart(StreamTime stream, HostTime host) noexcept;

    ClockLine line_;
    double seconds_since_restart_ = 0.0;
};

}  // namespace raks::engine
