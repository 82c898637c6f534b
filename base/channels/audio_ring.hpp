#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/assert.hpp"
#include "base/realtime.hpp"

namespace raks {

/// Ring buffer of float samples (interleaved or mono, as its users agree) from one writer to one
/// reader, for blocks of any size. Both calls transfer what fits and return how much that was.
///
/// Non-blocking guarantees: all but the constructor are wait-free (at most two copies).
/// Threads: write from one thread, read from one thread. Real-time: yes, but the constructor.
class AudioRing {
 public:
    /// Room for exactly `capacity` samples, >= 1.
    explicit AudioRing(std::size_t capacity) : samples_(capacity) { RAKS_ASSERT(capacity >= 1); }
    AudioRing(const AudioRing&) = delete;  ///< not copyable: both threads refer to this one
    AudioRing& operator=(const AudioRing&) = delete;  ///< not assignable

    [[nodiscard]] std::size_t capacity() const noexcept { return samples_.size(); }  ///< samples

    /// Appends as many of `block` as fit; returns how many.
    std::size_t write(std::span<const float> block) noexcept RAKS_NONBLOCKING {
        // relaxed: own index. acquire: pairs with the release in read().
        const std::uint64_t head = head_.load(std::memory_order_relaxed);
        const std::uint64_t used = head - tail_.load(std::memory_order_acquire);
        const std::size_t count = std::min(block.size(), samples_.size() - used);
        copy_in(head, block.first(count));
        // release: pairs with the acquire in read().
        head_.store(head + count, std::memory_order_release);
        return count;
    }

    /// Takes up to block.size() samples out; returns how many.
    std::size_t read(std::span<float> block) noexcept RAKS_NONBLOCKING {
        // relaxed: own index. acquire: pairs with the release in write().
        const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
        const std::uint64_t ready = head_.load(std::memory_order_acquire) - tail;
        const std::size_t count = std::min<std::size_t>(block.size(), ready);
        copy_out(tail, block.first(count));
        // release: pairs with the acquire in write().
        tail_.store(tail + count, std::memory_order_release);
        return count;
    }

    /// Samples that a read() by the reader gets at least; the writer sees an upper bound.
    [[nodiscard]] std::size_t readable() const noexcept RAKS_NONBLOCKING {
        const std::uint64_t tail = tail_.load(std::memory_order_acquire);
        return static_cast<std::size_t>(head_.load(std::memory_order_acquire) - tail);
    }
    /// Samples that a write() by the writer takes at least; the reader sees an upper bound.
    [[nodiscard]] std::size_t writable() const noexcept RAKS_NONBLOCKING {
        return samples_.size() - readable();
    }

 private:
    void copy_in(std::uint64_t at, std::span<const float> block) noexcept {
        const std::size_t start = at % samples_.size();
        const std::size_t first = std::min(block.size(), samples_.size() - start);
        std::copy_n(block.data(), first, samples_.data() + start);
        std::copy_n(block.data() + first, block.size() - first, samples_.data());
    }
    void copy_out(std::uint64_t at, std::span<float> block) const noexcept {
        const std::size_t start = at % samples_.size();
        const std::size_t first = std::min(block.size(), samples_.size() - start);
        std::copy_n(samples_.data() + start, first, block.data());
        std::copy_n(samples_.data(), block.size() - first, block.data() + first);
    }

    std::vector<float> samples_;
    alignas(64) std::atomic<std::uint64_t> head_{0};
    alignas(64) std::atomic<std::uint64_t> tail_{0};
};

}  // namespace raks
