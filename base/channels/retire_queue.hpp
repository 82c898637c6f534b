#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "base/channels/event_queue.hpp"
#include "base/realtime.hpp"

namespace raks {

/// Brings what a real-time thread no longer needs back to a thread that may free it.
///
/// Non-blocking guarantees: retire is wait-free. collect frees, so it may block.
/// Threads: retire from one real-time thread, collect and destruction on one worker.
template <typename T>
class RetireQueue {
 public:
    explicit RetireQueue(std::size_t capacity) : queue_(capacity) {}
    RetireQueue(const RetireQueue&) = delete;
    RetireQueue& operator=(const RetireQueue&) = delete;
    ~RetireQueue() { collect(); }

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
