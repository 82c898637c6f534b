#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "audio/io/device_stream.hpp"

namespace raks::audio {

/// Stands between a device's thread and what it calls: closed, blocks pass by (silence). A device
/// calls from the moment that it is open, before its rate is known, and one that will not stop may
/// call again after all that it called is gone.
/// Threads: open and close on main; the callbacks on the device's one thread. Real-time: the
/// callbacks, yes.
class CallbackGate {
 public:
    /// From now on blocks reach `callback`.
    void open(StreamCallback& callback) noexcept { callback_.store(&callback); }

    /// No block reaches it any more, and none that did is still on its way: waits for that one.
    void close() noexcept {
        callback_.store(nullptr);
        while (is_calling_.load()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    void on_input(std::span<const float> interleaved,
                  int channels,
                  const BlockTime& time) noexcept {
        call([&](StreamCallback& callback) { callback.on_input(interleaved, channels, time); });
    }
    void on_output(std::span<float> interleaved, int channels, const BlockTime& time) noexcept {
        call([&](StreamCallback& callback) { callback.on_output(interleaved, channels, time); });
    }

 private:
    // Sequentially consistent, all four: either the device's thread sees that the gate is closed,
    // or close() sees that it calls. (Each writes one and then reads the other's.)
    template <typename Block>
    void call(const Block& block) noexcept {
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
