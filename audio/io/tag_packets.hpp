#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace raks::audio {

/// Tells the packets of an MP3 or AAC stream that hold a tag or padding instead of sound: what
/// players put behind the music, and what lies between files that were joined. A decoder refuses
/// them, and nothing is lost. Threads: one. Real-time: no.
class TagPackets {
 public:
    /// Whether a packet that the decoder has refused holds no sound. Packets in order.
    [[nodiscard]] bool is_tag(std::span<const std::uint8_t> packet) noexcept;

 private:
    std::size_t tag_left_ = 0;  // bytes of a tag that further packets hold
};

}  // namespace raks::audio
