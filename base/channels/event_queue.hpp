#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/assert.hpp"
#include "base/realtime.hpp"

namespace raks {

/// Bounded first-in first-out queue from one producer to one consumer. When it is full, push drops
/// the new event, returns false and counts it, so that the consumer can detect the gap.
///
/// Non-blocking guarantees: push and pop are wait-free.
/// Threads: push from one thread, pop from one thread, dropped() from any.
/// Real-time: push, pop, size, dropped: yes. The constructor allocates.
template <typename T>
class EventQueue {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    /// Room for exactly `capacity` events, >= 1.
    explicit EventQueue(std::size_t capacity) : slots_(capacity) { RAKS_ASSERT(capacity >= 1); }
    EventQueue(const EventQueue&) = delete;  ///< not copyable: both threads refer to this one
    EventQueue& operator=(const EventQueue&) = delete;  ///< not assignable

    /// False when the queue was full and the event was dropped.
    bool push(const T& event) noexcept RAKS_NONBLOCKING {
        // relaxed: only this thread writes head_.
        const std::uint64_t head = head_.load(std::memory_order_relaxed);
        // acquire: pairs with the release in pop(): the slot is read before it is overwritten.
        if (head - tail_.load(std::memory_order_acquire) == slots_.size()) {
            // relaxed: a statistic, it orders nothing.
            dropped_.fetch_add(1, std::memory_order_relaxed);
            return false;
        }
        slots_[head % slots_.size()] = event;
        // release: pairs with the acquire in pop(): the event is whole when it is seen.
        head_.store(head + 1, std::memory_order_release);
        return true;
    }

    /// False when empty; `event` is then untouched.
    bool pop(T& event) noexcept RAKS_NONBLOCKING {
        // relaxed: only this thread writes tail_.
        const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
        // acquire: pairs with the release in push().
        if (tail == head_.load(std::memory_order_acquire)) {
            return false;
        }
        event = slots_[tail % slots_.size()];
        // release: pairs with the acquire in push().
        tail_.store(tail + 1, std::memory_order_release);
        return true;
    }

    /// Events waiting, as seen by the consumer (a producer sees an upper bound).
    [[nodiscard]] std::size_t size() const noexcept RAKS_NONBLOCKING {
        // acquire: pairs with the releases in push() and pop().
        const std::uint64_t tail = tail_.load(std::memory_order_acquire);
        return static_cast<std::size_t>(head_.load(std::memory_order_acquire) - tail);
    }

    /// Events lost because the queue was full, since construction.
    [[nodiscard]] std::uint64_t dropped() const noexcept RAKS_NONBLOCKING {
        return dropped_.load(std::memory_order_relaxed);  // relaxed: a statistic
    }

 private:
    static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

    std::vector<T> slots_;
    // 64-bit counters never wrap in practice: 500 years at 1e9 events a second.
    alignas(64) std::atomic<std::uint64_t> head_{0};
    alignas(64) std::atomic<std::uint64_t> tail_{0};
    alignas(64) std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace raks
