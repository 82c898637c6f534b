#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <span>
#include <string>

#include "audio/io/callback_gate.hpp"
#include "audio/io/stream_callback.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// The blocks of one stream on their way to its callback: counts them and keeps signs of life.
/// Every kind of stream has one, on the heap: a device's thread that cannot be stopped keeps using
/// it after its stream is gone.
///
/// Threads: take_* on the device's one thread, the rest on any. Real-time: take_* yes.
class CountedBlocks {
 public:
    /// `channels` of each block.
    explicit CountedBlocks(int channels) : channels_(channels) {}

    /// A recorded block, interleaved, that was handed over at `entered`.
    void take_input(std::span<const float> interleaved, HostTime entered) noexcept RAKS_NONBLOCKING;
    /// A block to be filled; it is silent where the gate is closed.
    void take_output(std::span<float> interleaved, HostTime entered) noexcept RAKS_NONBLOCKING;
    /// The device lost or repeated audio: the next block is flagged. From any thread.
    void note_xrun() noexcept RAKS_NONBLOCKING;

    /// The switch to the callback.
    [[nodiscard]] CallbackGate& gate() noexcept { return gate_; }
    /// Channels of each block.
    [[nodiscard]] int channels() const noexcept { return channels_; }
    /// Blocks so far.
    [[nodiscard]] std::uint64_t callbacks() const noexcept;
    /// Xruns so far.
    [[nodiscard]] std::uint64_t xruns() const noexcept;
    /// Frames of the newest block; 0 before the first.
    [[nodiscard]] int block_frames() const noexcept RAKS_NONBLOCKING;
    /// When the newest block passed; the epoch before the first.
    [[nodiscard]] HostTime last_block() const noexcept;
    /// Frames of all blocks so far. Threads: the device's.
    [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }
    /// Scheduling class of the thread that brings the blocks: see DeviceStream::scheduling().
    [[nodiscard]] std::string scheduling() const;

 private:
    BlockTime begin(std::size_t samples, HostTime entered) noexcept RAKS_NONBLOCKING;

    CallbackGate gate_;
    int channels_;
    std::int64_t frames_ = 0;  // counted by the device's thread alone
    // Relaxed order is enough: each value is a statistic or a sign of life by itself.
    std::atomic<std::uint64_t> callbacks_{0};
    std::atomic<std::uint64_t> xruns_{0};
    std::atomic<bool> has_xrun_{false};  // since the last block
    std::atomic<std::int64_t> last_block_ns_{0};
    std::atomic<int> block_frames_{0};
    std::atomic<pthread_t> thread_{};
};

}  // namespace raks::audio
