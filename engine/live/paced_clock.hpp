#pragma once

#include <atomic>
#include <thread>

#include "audio/io/device_stream.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Our own clock in place of a device: calls a stream callback every 256 frames' time by
/// CLOCK_MONOTONIC. Drives `--no-sound`, and whatever goes on after a device has died. An input
/// gets silence; what an output fills is thrown away. Threads: create and destroy on main; the
/// callback runs on the clock's own thread.
class PacedClock {
 public:
    enum class Direction { input, output };

    PacedClock(Direction direction, SampleRate rate, int channels, audio::StreamCallback& callback);
    ~PacedClock();
    PacedClock(const PacedClock&) = delete;
    PacedClock& operator=(const PacedClock&) = delete;

 private:
    void run(Direction direction, SampleRate rate, int channels) noexcept;

    audio::StreamCallback& callback_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

}  // namespace raks::engine
