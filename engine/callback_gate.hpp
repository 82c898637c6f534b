#pragma once

#include <atomic>

#include "audio/io/device_stream.hpp"

namespace raks::engine {

/// Stands between a device and what it calls: closed, blocks pass by (silence). A device starts to
/// call as soon as it is open, before its rate is known; and one that died may, in theory, call
/// again after our own clock took over.
/// Threads: open and close on main. Real-time: the callbacks, yes.
class CallbackGate final : public audio::StreamCallback {
 public:
    /// From now on blocks reach `callback`.
    void open(audio::StreamCallback& callback) noexcept {
        // release: pairs with the acquires below: the callback is whole when it is called.
        callback_.store(&callback, std::memory_order_release);
    }
    void close() noexcept { callback_.store(nullptr, std::memory_order_release); }

    void on_input(std::span<const float> interleaved,
                  int channels,
                  const audio::BlockTime& time) noexcept override {
        if (audio::StreamCallback* callback = callback_.load(std::memory_order_acquire)) {
            callback->on_input(interleaved, channels, time);
        }
    }
    void on_output(std::span<float> interleaved,
                   int channels,
                   const audio::BlockTime& time) noexcept override {
        if (audio::StreamCallback* callback = callback_.load(std::memory_order_acquire)) {
            callback->on_output(interleaved, channels, time);
        }
    }

 private:
    std::atomic<audio::StreamCallback*> callback_{nullptr};
};

}  // namespace raks::engine
