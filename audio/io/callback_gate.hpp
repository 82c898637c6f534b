#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "audio/io/stream_callback.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// A switch between a device's thread and the callback: while it is closed, blocks are dropped (an
/// output stays silent). It is needed as a device calls from the moment it is opened, before its
/// rate is known, and as one that does not stop may call again after its callback is destroyed.
/// Threads: open and close on main; the callbacks on the device's one thread. Real-time: the
/// callbacks, yes.
class CallbackGate {
 public:
    /// From here on blocks reach `callback`.
    void open(StreamCallback& callback) noexcept { callback_.store(&callback); }

    /// From its return on no block reaches the callback, and no call is still running: waits for
    /// one.
    void close() noexcept {
        callback_.store(nullptr);
        while (is_calling_.load()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    /// Passes a recorded block on, if open.
    void on_input(std::span<const float> interleaved,
                  int channels,
                  const BlockTime& time) noexcept RAKS_NONBLOCKING {
        call([&](StreamCallback& callback) noexcept RAKS_NONBLOCKING {
            callback.on_input(interleaved, channels, time);
        });
    }
    /// Passes a block to be filled on, if open; closed, it stays as it came.
    void on_output(std::span<float> interleaved,
                   int channels,
                   const BlockTime& time) noexcept RAKS_NONBLOCKING {
        call([&](StreamCallback& callback) noexcept RAKS_NONBLOCKING {
            callback.on_output(interleaved, channels, time);
        });
    }

 private:
    // All four accesses are sequentially consistent: each side writes one variable and then reads
    // the other's, so either the device's thread sees that the gate is closed, or close() sees that
    // a call is running.
    template <typename Block>
    void call(const Block& block) noexcept RAKS_NONBLOCKING {
        is_calling_.store(true);
        if (StreamCallback* callback = callback_.load()) {
            block(*callback);
        }
        is_calling_.store(false);
    }

    std::atomic<StreamCallback*> callback_{nullptr};
    std::atomic<bool> is_calling_{false};
};

}  // namespace raks::audio
