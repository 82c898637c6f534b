#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace raks::audio {

/// One page of an Opus stream in Ogg (RFC 7845), as its head says.
struct OpusPage {
    std::int64_t granule = -1;  ///< samples of 48 kHz up to its last packet; -1: none ends in it
    bool is_last = false;       ///< of its stream
    std::string_view segments;  ///< their lengths, a byte each
    std::string_view body;      ///< the segments, one behind the other
};

/// Do the granule positions of an Opus stream agree with the lengths of its packets? Encoders that
/// follow the jitter of another file's time stamps write some that lie a few milliseconds off. Such
/// a file is whole, but a decoder that goes by them throws packets away.
/// Threads: one. Real-time: no.
class OpusStamps {
 public:
    /// The next page; those of the stream's two heads are known and passed over.
    void add(const OpusPage& page);

    /// False from the first page on whose position is not what its packets add to the one before:
    /// less is right on the last page alone, where it cuts the padding.
    [[nodiscard]] bool agree() const noexcept { return agree_; }

 private:
    void end_packet();

    std::string start_;          // the first two bytes of the packet that is open
    std::int64_t samples_ = 0;   // of the packets that ended since the last position
    std::int64_t last_ = -1;     // position of the last page that had one; -1: none yet
    std::uint64_t packets_ = 0;  // that ended
    bool agree_ = true;
};

/// Samples of 48 kHz in an Opus packet that begins so (RFC 6716, 3.1 and 3.2); 0 for an empty one.
[[nodiscard]] std::int64_t opus_packet_samples(std::string_view packet) noexcept;

}  // namespace raks::audio
