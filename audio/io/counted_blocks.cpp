#include "audio/io/counted_blocks.hpp"

#include <sched.h>

#include <algorithm>

#include "base/realtime.hpp"

namespace raks::audio {

// What input and output both do at the start of a block.
BlockTime CountedBlocks::begin(std::size_t samples, HostTime entered) noexcept RAKS_NONBLOCKING {
    const std::int64_t frames = static_cast<std::int64_t>(samples) / channels_;
    const BlockTime time{.first_frame = frames_,
                         .entered = entered,
                         .is_xrun = has_xrun_.exchange(false, std::memory_order_relaxed)};
    frames_ += frames;
    last_block_ns_.store(host_now().time_since_epoch().count(), std::memory_order_relaxed);
    block_frames_.store(static_cast<int>(frames), std::memory_order_relaxed);
    // Trusted in real time: glibc reads it from a register.
    thread_.store(RAKS_TRUSTED(pthread_self()), std::memory_order_relaxed);
    callbacks_.fetch_add(1, std::memory_order_relaxed);
    return time;
}

void CountedBlocks::take_input(std::span<const float> interleaved,
                               HostTime entered) noexcept RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    const BlockTime time = begin(interleaved.size(), entered);
    gate_.on_input(interleaved, channels_, time);
}

void CountedBlocks::take_output(std::span<float> interleaved,
                                HostTime entered) noexcept RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    const BlockTime time = begin(interleaved.size(), entered);
    std::fill(interleaved.begin(), interleaved.end(), 0.0F);
    gate_.on_output(interleaved, channels_, time);
}

void CountedBlocks::note_xrun() noexcept RAKS_NONBLOCKING {
    xruns_.fetch_add(1, std::memory_order_relaxed);
    has_xrun_.store(true, std::memory_order_relaxed);
}

std::uint64_t CountedBlocks::callbacks() const noexcept {
    return callbacks_.load(std::memory_order_relaxed);
}

std::uint64_t CountedBlocks::xruns() const noexcept {
    return xruns_.load(std::memory_order_relaxed);
}

int CountedBlocks::block_frames() const noexcept RAKS_NONBLOCKING {
    return block_frames_.load(std::memory_order_relaxed);
}

HostTime CountedBlocks::last_block() const noexcept {
    return HostTime(Nanos(last_block_ns_.load(std::memory_order_relaxed)));
}

std::string CountedBlocks::scheduling() const {
    int policy = 0;
    sched_param parameters{};
    if (callbacks() == 0 ||
        pthread_getschedparam(thread_.load(std::memory_order_relaxed), &policy, &parameters) != 0) {
        return "unknown";
    }
    // JACK sets this flag so that threads which its threads start do not inherit their priority. It
    // says nothing about the class of the thread itself.
    switch (policy & ~SCHED_RESET_ON_FORK) {
        case SCHED_FIFO:
            return "SCHED_FIFO";
        case SCHED_RR:
            return "SCHED_RR";
        default:
            return "SCHED_OTHER";
    }
}

}  // namespace raks::audio
