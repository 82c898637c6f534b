#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/time.hpp"

namespace raks::engine {

/// When the frames of a device's stream are heard, by the times at which its blocks were handed
/// over. Those are CLOCK_MONOTONIC, taken in the callback; late wake-ups are taken out by a running
/// median. Threads: any. Real-time: no.
class BlockClock {
 public:
    /// One block: the frame that DeviceStream::heard_after() dates (the first of an output's block,
    /// the one behind the last of an input's), and when it is heard.
    struct Mark {
        std::int64_t frame = 0;  ///< counted from the start
        HostTime heard{};        ///< BlockTime::entered and what heard_after() said then
    };

    /// Room for the marks of a stream is made for blocks of at least this many frames.
    static constexpr std::size_t kSmallestBlock = 16;

    /// `marks`: ascending by frame.
    BlockClock(SampleRate rate, std::vector<Mark> marks) : rate_(rate), marks_(std::move(marks)) {}

    /// Of the frames.
    [[nodiscard]] SampleRate rate() const noexcept { return rate_; }
    /// Host time at which this frame is heard: the median over the blocks within half a second.
    /// Needs at least one mark.
    [[nodiscard]] HostTime heard_at(std::int64_t frame) const;
    /// About which frame is heard at a host time, by the last block before it alone: off by what
    /// that one was late. Needs at least one mark.
    [[nodiscard]] std::int64_t frame_near(HostTime host) const;

 private:
    SampleRate rate_;
    std::vector<Mark> marks_;
};

}  // namespace raks::engine
