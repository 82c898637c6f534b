#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "base/channels/event_queue.hpp"
#include "base/realtime.hpp"

namespace raks {

/// Passes objects that a real-time thread no longer needs to a thread that may free them.
///
/// Non-blocking guarantees: retire is wait-free. collect frees, so it may block.
/// Threads: retire from one real-time thread, collect and destruction on one worker.
template <typename T>
class RetireQueue {
 public:
    /// Room for `capacity` objects, >= 1.
    explicit RetireQueue(std::size_t capacity) : queue_(capacity) {}
    RetireQueue(const RetireQueue&) = delete;  ///< not copyable: both threads refer to this one
    RetireQueue& operator=(const RetireQueue&) = delete;  ///< not assignable
    ~RetireQueue() { collect(); }  ///< frees what is left; no retire() may run

    /// Takes the object over. When the queue is full the object stays in `object` and false is
    /// returned: keep it and try again at a later tick; never free it here.
    bool retire(std::unique_ptr<T>& object) noexcept RAKS_NONBLOCKING {
        if (!object) {
            return true;
        }
        if (!queue_.push(object.get())) {
            return false;
        }
        static_cast<void>(object.release());
        return true;
    }

    /// Frees everything retired so far; returns how many objects.
    std::size_t collect() {
        std::size_t count = 0;
        T* object = nullptr;
        while (queue_.pop(object)) {
            const std::unique_ptr<T> owner(object);
            ++count;
        }
        return count;
    }

 private:
    EventQueue<T*> queue_;
};

}  // namespace raks
