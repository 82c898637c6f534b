#pragma once

#include <cstdint>
#include <span>

#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// When a block passed the device, and where in the stream it lies.
struct BlockTime {
    std::int64_t first_frame = 0;  ///< frames of this stream before the block
    /// CLOCK_MONOTONIC at which the block was handed over: when the callback was entered, or, where
    /// the device tells how far it has played, that time without the thread's jitter.
    HostTime entered{};
    bool is_xrun = false;  ///< the device lost or repeated audio before this block
};

/// Code that runs on the device's audio thread, with flush-to-zero set.
/// Real-time: must be (no allocation, locks or system calls).
class StreamCallback {
 public:
    /// Destroyed by its owner, after the stream or abandon(): see DeviceStream::connect().
    virtual ~StreamCallback() = default;
    /// A block from an input stream, interleaved; any number of frames from 1 up.
    virtual void on_input(std::span<const float> /*interleaved*/,
                          int /*channels*/,
                          const BlockTime& /*time*/) noexcept RAKS_NONBLOCKING {}
    /// A block for an output stream, interleaved, to be filled completely (it is zeroed before).
    virtual void on_output(std::span<float> /*interleaved*/,
                           int /*channels*/,
                           const BlockTime& /*time*/) noexcept RAKS_NONBLOCKING {}
};

}  // namespace raks::audio
