#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

#include "base/realtime.hpp"

namespace raks {

/// Passes the newest value from one writer to one reader; older values are overwritten by design. A
/// triple buffer: each side owns one slot, the third changes hands with one atomic exchange.
///
/// Non-blocking guarantees: write, write_with and read are wait-free (one copy, one exchange).
/// Threads: write from one thread, read from one thread. Real-time: yes, both.
template <typename T>
class LatestValue {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    LatestValue() noexcept = default;          ///< holds a value-initialized T
    LatestValue(const LatestValue&) = delete;  ///< not copyable: both threads refer to this one
    LatestValue& operator=(const LatestValue&) = delete;  ///< not assignable

    /// Publishes a copy of `value`.
    void write(const T& value) noexcept RAKS_NONBLOCKING {
        write_with([&value](T& slot) { slot = value; });
    }

    /// Publishes what `fill` makes of a slot that holds some older value: for a large T of which a
    /// part is in use. `fill` must not throw, nor block.
    template <typename Fill>
    void write_with(Fill fill) noexcept RAKS_NONBLOCKING {
        fill(slots_[write_index_].value);
        // release: pairs with the acquire in read(), which then sees the whole value;
        // acquire: the slot we get back was given up by read()'s release.
        const std::uint8_t old = shared_.exchange(static_cast<std::uint8_t>(write_index_ | kFresh),
                                                  std::memory_order_acq_rel);
        write_index_ = static_cast<std::uint8_t>(old & kIndexMask);
    }

    /// The newest value written, or a value-initialized T before the first. The reference holds
    /// until the next read(). `is_new`, if given, says whether it was written since the last read.
    const T& read(bool* is_new = nullptr) noexcept RAKS_NONBLOCKING {
        // relaxed: only a hint whether an exchange is worth it; the exchange synchronizes.
        const bool fresh = (shared_.load(std::memory_order_relaxed) & kFresh) != 0;
        if (fresh) {
            // acquire/release: the counterpart of the exchange in write().
            const std::uint8_t old = shared_.exchange(read_index_, std::memory_order_acq_rel);
            read_index_ = static_cast<std::uint8_t>(old & kIndexMask);
        }
        if (is_new != nullptr) {
            *is_new = fresh;
        }
        return slots_[read_index_].value;
    }

 private:
    static constexpr std::uint8_t kIndexMask = 3;
    static constexpr std::uint8_t kFresh = 4;
    static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

    struct alignas(64) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(64) std::uint8_t write_index_ = 0;         // writer's own
    alignas(64) std::atomic<std::uint8_t> shared_{1};  // index of the free slot | fresh bit
    alignas(64) std::uint8_t read_index_ = 2;          // reader's own
};

}  // namespace raks
