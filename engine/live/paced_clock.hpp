#pragma once

#include <atomic>
#include <thread>

#include "audio/io/stream_callback.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Our own clock in place of a device: calls a stream callback every 256 frames' time by
/// CLOCK_MONOTONIC. Drives `--no-sound`, and `live` while its device is gone. An input gets
/// silence; what an output fills is thrown away. Threads: create and destroy on main; the callback
/// runs on the clock's own thread.
class PacedClock {
 public:
    /// Which of the callback's two functions is called.
    enum class Direction { input, output };

    /// Starts calling `callback`, which must outlive this, with blocks of `channels` at `rate`.
    PacedClock(Direction direction, SampleRate rate, int channels, audio::StreamCallback& callback);
    ~PacedClock();  ///< stops the calls and joins the thread
    /// Not copied: the thread holds a reference to it.
    PacedClock(const PacedClock&) = delete;
    PacedClock& operator=(const PacedClock&) = delete;  ///< likewise

 private:
    void run(Direction direction, SampleRate rate, int channels) noexcept;

    audio::StreamCallback& callback_;
    std::atomic<bool> is_stopping_{false};
    std::thread thread_;
};

}  // namespace raks::engine
